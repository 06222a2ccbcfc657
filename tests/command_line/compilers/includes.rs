//! Includes of a shader, from its own folder and nowhere else.

use std::fs;
use std::os::unix::fs::symlink;

use tests::root;
use tests::text::assert_contains;

use super::installed::install_glslang;
use super::{BINDINGS, COPY, list, refuse, write_compiler, write_pass};
use crate::sandbox::{Sandbox, assert_done};

const GLSL: &str = "#version 450\n#extension GL_GOOGLE_include_directive : require\n";

/// Writes a file that reveals when a compiler opens it; returns its path.
fn write_secret(sandbox: &Sandbox) -> String {
    let path = sandbox.path("secret.txt");
    fs::write(&path, "#error the_secret\n").unwrap();
    path.display().to_string()
}

/// Shaders, the line of the message, a text that leads outside of the folder, and what the message
/// says.
const OUTSIDE: [(&[&str], u32, &str, &str); 10] = [
    (
        &["blur.comp"],
        3,
        r#"#include "../../../etc/passwd""#,
        "outside the filter's folder",
    ),
    (
        &["blur.comp"],
        3,
        r#"#include "in/../../secret.txt""#,
        "outside the filter's folder",
    ),
    (
        &["blur.comp"],
        3,
        "#inc\\\nlude \"SECRET\"",
        "outside the filter's folder",
    ),
    (
        &["blur.comp"],
        1,
        r#"#include "own.h""#,
        "outside the filter's folder",
    ),
    (
        &["blur.comp"],
        4,
        "#define FILE \"SECRET\"\n#include FILE",
        "by a macro",
    ),
    (
        &["blur.comp"],
        3,
        r#"#include "link.h""#,
        "outside the filter's folder",
    ),
    (
        &["blur.comp"],
        3,
        r#"#include "linked/secret.txt""#,
        "outside the filter's folder",
    ),
    (
        &["blur.hlsl", "blur.fx", "blur.slang"],
        2,
        "\n# include <../secret.txt>",
        "outside the filter's folder",
    ),
    (
        &["blur.hlsl", "blur.fx", "blur.slang"],
        2,
        "\n#include \"SECRET\"",
        "outside the filter's folder",
    ),
    (
        &["blur.slang"],
        2,
        "\nimport \"../secret\";",
        "outside the filter's folder",
    ),
];

/// A stranger's shader includes files of its own folder only.
#[test]
fn nothing_outside_of_the_folder_is_included() {
    let sandbox = Sandbox::new();
    let secret = write_secret(&sandbox);
    let folder = sandbox.path("translated");
    let write = |file: &str| {
        _ = fs::remove_dir_all(&folder);
        write_pass(&sandbox, file, "");
        // A compiler that would reveal it.
        for program in ["glslangValidator", "slangc", "wesl"] {
            write_compiler(&sandbox, program, "echo the_secret; exit 1");
        }
    };
    let refuse = |parts: &[&str]| {
        let said = refuse(&sandbox);
        assert_contains(&said, parts);
        assert!(!said.contains("the_secret"), "{said}");
    };
    for (files, line, text, says) in OUTSIDE {
        for file in files {
            write(file);
            let head = if *file == "blur.comp" { GLSL } else { "" };
            let text = text.replace("SECRET", &secret);
            fs::write(folder.join(file), format!("{head}{text}\n")).unwrap();
            let include = format!("#include \"{secret}\"\n");
            fs::write(folder.join("own.h"), include).unwrap();
            symlink(&secret, folder.join("link.h")).unwrap();
            symlink(sandbox.path(""), folder.join("linked")).unwrap();
            let named = if line == 1 { "own.h" } else { file };
            refuse(&[&format!("translated/{named}:{line}: "), says]);
        }
    }
    // Modules of WESL and Slang are found by name.
    for (file, link) in [("blur.wesl", "secret.wesl"), ("blur.slang", "secret.slang")] {
        write(file);
        symlink(&secret, folder.join(link)).unwrap();
        refuse(&[&format!("translated/{link}: is a link")]);
    }
    // A shader, too, is a file of the folder.
    write("blur.comp");
    fs::remove_file(folder.join("blur.comp")).unwrap();
    symlink(&secret, folder.join("blur.comp")).unwrap();
    refuse(&["translated/blur.comp: is a link to a file outside of the filter's folder"]);
}

/// A compiler searches the folders of all files that are being included.
#[test]
fn no_folder_of_an_includer_leads_outside() {
    let sandbox = Sandbox::new();
    write_secret(&sandbox);
    let folder = sandbox.path("translated");
    fs::create_dir_all(folder.join("p/q/r/s")).unwrap();
    write_pass(&sandbox, "p/q/blur.comp", "");
    for (file, head, includes) in [
        ("p/q/blur.comp", GLSL, "../../top.h"),
        ("top.h", "", "p/q/r/s/deep.h"),
        // The path stays in the folder if it is taken from p/q/r/s or p/q, and leaves it from the
        // folder of top.h.
        ("p/q/r/s/deep.h", "", "../../secret.txt"),
    ] {
        let text = format!("{head}#include \"{includes}\"\n");
        fs::write(folder.join(file), text).unwrap();
    }
    install_glslang(&sandbox);
    let said = refuse(&sandbox);
    let parts = [
        "deep.h:1",
        "../../secret.txt",
        "which is no file of this filter",
    ];
    assert_contains(&said, &parts);
    assert!(!said.contains("the_secret"), "{said}");
}

/// Includes of a file outside of the filter's folder.
const FROM_OUTSIDE: [&str; 12] = [
    r#"#include "{secret}""#,
    r#"#include "{place}""#,
    "#define U \"\\\"/*\"\n#include \"{secret}\"\n",
    "/\\\n* \" */ #include \"{secret}\"\n",
    "#define U \"/*\n\"*/ #include \"{secret}\"\n",
    "#inc\\\r\nlude \"{secret}\"\n",
    "#/**/include \"{secret}\"\n",
    "# include <{secret}>\n",
    "#define F \"{secret}\"\n#include F\n",
    "#define F <{secret}>\n#include F\n",
    "#line 1 \"{folder}/x\"\n#include \"secret.txt\"\n",
    "#include \"zz/../../secret.txt\"\n",
];

/// Comments, joined lines, macros and `#line` do not let an include leave the folder.
#[test]
fn includes_out_of_the_folder_are_refused_however_they_are_written() {
    let sandbox = Sandbox::new();
    let place = write_secret(&sandbox);
    install_glslang(&sandbox);
    // The path begins in the folder of the copies: a compiler may join an absolute path to that
    // folder.
    let secret = format!("{}..{place}", "../".repeat(11));
    let folder = sandbox.path("").display().to_string();
    let words: [(&str, &str); 3] = [
        ("{secret}", &secret),
        ("{place}", &place),
        ("{folder}", &folder),
    ];
    for line in FROM_OUTSIDE {
        let replace = |text: String, (from, to): &(&str, &str)| text.replace(from, to);
        let text = words.iter().fold(line.to_owned(), replace);
        _ = fs::remove_dir_all(sandbox.path("translated"));
        write_pass(&sandbox, "blur.comp", "");
        fs::create_dir_all(sandbox.path("translated/zz")).unwrap();
        let shader = format!("{GLSL}{text}\nvoid main() {{}}\n");
        sandbox.put("translated/blur.comp", shader);
        let said = refuse(&sandbox);
        assert!(!said.contains("the_secret"), "{text}: {said}");
        assert!(said.contains("translated/blur.comp"), "{text}: {said}");
    }
}

/// Lines keep their numbers, in the shader and in its includes.
#[test]
fn honest_includes_work_and_errors_name_their_lines() {
    let sandbox = Sandbox::new();
    install_glslang(&sandbox);
    let folder = sandbox.path("translated");
    fs::create_dir_all(folder.join("in/lib/deep")).unwrap();
    write_pass(&sandbox, "in/blur.comp", BINDINGS);
    fs::write(folder.join("copy.wgsl"), COPY).unwrap();
    let fastest = root().join("tests/fixtures/shaders/fastest.comp");
    let fastest = fs::read_to_string(fastest).unwrap();
    let fastest = fastest.trim_start_matches("#[compute]\n");
    let (version, body) = fastest.split_once('\n').unwrap();
    let shader = |body: &str| {
        format!(
            "\u{feff}/* Comments, // of both\r\nkinds */ {version}\r\n\
             #extension GL_GOOGLE_include_directive \\\r\n  : require\r\n\
             #include \"lib/a.h\" // beside it, and \"twice\"\r\n\
             #include <lib/../lib/a.h>\r\n\
             #ifdef UNITY\r\n#include \"UnityCG.cginc\"\r\n#endif\r\n{body}"
        )
    };
    let write = |file: &str, text: &str| fs::write(folder.join("in").join(file), text).unwrap();
    write("blur.comp", &shader(&body.replace('\n', "\r\n")));
    // The two files include each other. Of the two paths only the second is a file, next to the
    // shader.
    write(
        "lib/a.h",
        "#ifndef A_H\n#define A_H\n#include \"deep/b.h\"\nfloat a() { return b(); }\n#endif\n",
    );
    write(
        "lib/deep/b.h",
        "#ifndef B_H\n#define B_H\n#include \"../a.h\"\n#include \"lib/c.h\"\nfloat b() { return c; }\n#endif\n",
    );
    write(
        "lib/c.h",
        "#define JOINED(x) \\\n  (x) \\\n\nconst float c = JOINED(1.0);\n",
    );
    assert_done(&list(&sandbox));
    let breaks = |file: &str, text: &str, line: &str| {
        let place = folder.join("in").join(file);
        let honest = fs::read_to_string(&place).unwrap();
        fs::write(&place, text).unwrap();
        assert_contains(&refuse(&sandbox), &[line, "broken"]);
        fs::write(&place, honest).unwrap();
    };
    // Before the body: two lines of the comment, two that are joined, two includes, and three lines
    // that a condition leaves out.
    let text = shader("int a = broken;\r\n");
    breaks("blur.comp", &text, "translated/in/blur.comp:10: ");
    let joined = "#define JOINED(x) \\\n  (x) \\\n\nint a = broken;\n";
    breaks("lib/c.h", joined, "c.h:4");
}

/// Each copy names modules relative to itself, so the compiler searches there first.
#[test]
fn modules_are_named_from_the_copy_itself() {
    let sandbox = Sandbox::new();
    let folder = sandbox.path("translated");
    fs::create_dir_all(folder.join("in/lib")).unwrap();
    write_pass(&sandbox, "in/blur.slang", "");
    let write = |file: &str, text: &str| fs::write(folder.join("in").join(file), text).unwrap();
    write(
        "blur.slang",
        "import lib.other; import \"lib/other\";\nimport \"lib/../noise.slang\";\n#include \"own.h\" // why\n",
    );
    write("own.h", "");
    write("noise.slang", "");
    // Only next to the shader is there a file of that name.
    write(
        "lib/other.slang",
        "__include\n\"noise\"; import \"nowhere\";\n",
    );
    let script = "for word; do case \"$word\" in *.slang) \
                  /bin/cat \"$word\" \"${word%/*}/lib/other.slang\";; esac; done; exit 1";
    write_compiler(&sandbox, "slangc", script);
    let parts = [
        "import lib.other; import \"lib/other\";",
        "import \"noise.slang\";",
        "#include \"own.h\"\n",
        "\"../noise\"; import \"nowhere\";",
    ];
    assert_contains(&refuse(&sandbox), &parts);
    write("blur.slang", "import \"../nowhere\";\n");
    let says = "blur.slang:1: imports \"../nowhere\", which is no file";
    assert_contains(&refuse(&sandbox), &[says]);
}
