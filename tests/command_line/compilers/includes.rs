//! What a shader includes, from its own folder and from nowhere else.

use std::fs;

use tests::filter_folder::write_script;
use tests::root;

use super::installed::find_program;
use super::{BINDINGS, COPY, list, write_pass};
use crate::sandbox::{Sandbox, assert_done, stderr};

/// What a stranger's shader includes comes from its own folder.
#[test]
fn nothing_outside_of_the_folder_is_included() {
    let sandbox = Sandbox::new();
    fs::write(sandbox.path("secret.txt"), "the secret\n").unwrap();
    let secret = sandbox.path("secret.txt").display().to_string();
    let outside = "outside of the filter's folder";
    let glsl = "#version 450\n#extension GL_GOOGLE_include_directive : require\n";
    // (file, text, line, part of the message)
    let mut cases = vec![
        (
            "blur.comp",
            format!("{glsl}#include \"../../../etc/passwd\"\n"),
            3,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#include \"in/../../secret.txt\"\n"),
            3,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#inc\\\nlude \"{secret}\"\n"),
            3,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#include \"own.h\"\n"),
            1,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#define FILE \"{secret}\"\n#include FILE\n"),
            4,
            "by a macro",
        ),
        (
            "blur.comp",
            format!("{glsl}#include \"link.h\"\n"),
            3,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#define U \"\\\"/*\"\n#include \"{secret}\"\n"),
            4,
            outside,
        ),
        (
            "blur.comp",
            format!("{glsl}#include \"linked/secret.txt\"\n"),
            3,
            outside,
        ),
    ];
    for (file, line) in [("blur.hlsl", 2), ("blur.fx", 2), ("blur.slang", 2)] {
        cases.push((file, "\n# include <../secret.txt>\n".into(), line, outside));
        cases.push((file, format!("\n#include \"{secret}\"\n"), line, outside));
    }
    cases.push(("blur.slang", "\nimport \"../secret\";\n".into(), 2, outside));
    for (file, text, line, says) in cases {
        let folder = sandbox.path("translated");
        _ = fs::remove_dir_all(&folder);
        write_pass(&sandbox, file, "");
        fs::write(folder.join(file), &text).unwrap();
        fs::write(folder.join("own.h"), format!("#include \"{secret}\"\n")).unwrap();
        std::os::unix::fs::symlink(&secret, folder.join("link.h")).unwrap();
        std::os::unix::fs::symlink(sandbox.path(""), folder.join("linked")).unwrap();
        fs::create_dir_all(sandbox.path("bin")).unwrap();
        // A compiler that would tell.
        for program in ["glslangValidator", "slangc"] {
            write_script(
                &sandbox.path("bin").join(program),
                "echo the secret; exit 1",
            );
        }
        let listed = list(&sandbox);
        assert_eq!(listed.status.code(), Some(2), "{text}");
        let said = stderr(&listed);
        let named = if text.contains("own.h") {
            "own.h"
        } else {
            file
        };
        for part in [&format!("translated/{named}:{line}: ")[..], says] {
            assert!(said.contains(part), "{text}: no \"{part}\" in: {said}");
        }
        assert!(!said.contains("the secret"), "{said}");
    }
    // Modules of WESL and Slang are looked for by their names.
    for (file, link) in [("blur.wesl", "secret.wesl"), ("blur.slang", "secret.slang")] {
        let folder = sandbox.path("translated");
        _ = fs::remove_dir_all(&folder);
        write_pass(&sandbox, file, "");
        std::os::unix::fs::symlink(&secret, folder.join(link)).unwrap();
        write_script(&sandbox.path("bin/wesl"), "echo the secret; exit 1");
        let said = stderr(&list(&sandbox));
        assert!(
            said.contains(&format!("translated/{link}: is a link")),
            "{said}"
        );
    }
}

/// Puts the real glslangValidator, and nothing else, on the bench's PATH.
fn install_glslang(sandbox: &Sandbox) {
    let found = find_program("glslangValidator").expect("apt-get install glslang-tools");
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    _ = std::os::unix::fs::symlink(found, sandbox.path("bin/glslangValidator"));
}

/// Writes a file that says so if a compiler opens it.
fn write_secret(sandbox: &Sandbox) {
    fs::write(sandbox.path("secret.txt"), "#error the_secret\n").unwrap();
}

const GLSL: &str = "#version 450\n#extension GL_GOOGLE_include_directive : require\n";

/// A compiler looks for a file in the folders of all files that are being included.
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
        // From p/q/r/s and from p/q it stays within, from the folder of top.h it does not.
        ("p/q/r/s/deep.h", "", "../../secret.txt"),
    ] {
        let text = format!("{head}#include \"{includes}\"\n");
        fs::write(folder.join(file), text).unwrap();
    }
    install_glslang(&sandbox);
    let said = stderr(&list(&sandbox));
    let parts = [
        "deep.h:1",
        "../../secret.txt",
        "which is no file of this filter",
    ];
    tests::text::assert_contains(&said, &parts);
    assert!(!said.contains("the_secret"), "{said}");
}

/// What glslangValidator opened once because the program took it for a comment, for text in quotes or for no directive.
#[test]
fn no_directive_is_hidden_from_the_program() {
    let sandbox = Sandbox::new();
    write_secret(&sandbox);
    install_glslang(&sandbox);
    // From the folder of the copies: a compiler may join an absolute path to that.
    let secret = format!(
        "{}..{}",
        "../".repeat(11),
        sandbox.path("secret.txt").display()
    );
    let include = format!("#include \"{secret}\"");
    let texts = [
        include.clone(),
        format!("#include \"{}\"", sandbox.path("secret.txt").display()),
        format!("#define U \"\\\"/*\"\n{include}\n"),
        format!("/\\\n* \" */ {include}\n"),
        format!("#define U \"/*\n\"*/ {include}\n"),
        format!("#inc\\\r\nlude \"{secret}\"\n"),
        format!("#/**/include \"{secret}\"\n"),
        format!("# include <{secret}>\n"),
        format!("#define F \"{secret}\"\n#include F\n"),
        format!("#define F <{secret}>\n#include F\n"),
        format!(
            "#line 1 \"{}/x\"\n#include \"secret.txt\"\n",
            sandbox.path("").display()
        ),
        "#include \"zz/../../secret.txt\"\n".to_owned(),
    ];
    for text in texts {
        _ = fs::remove_dir_all(sandbox.path("translated"));
        write_pass(&sandbox, "blur.comp", "");
        fs::create_dir_all(sandbox.path("translated/zz")).unwrap();
        let shader = format!("{GLSL}{text}\nvoid main() {{}}\n");
        fs::write(sandbox.path("translated/blur.comp"), shader).unwrap();
        let listed = list(&sandbox);
        assert_eq!(listed.status.code(), Some(2), "{text}");
        let said = stderr(&listed);
        assert!(!said.contains("the_secret"), "{text}: {said}");
        assert!(said.contains("translated/blur.comp"), "{text}: {said}");
    }
}

/// Lines keep their numbers, in the shader and in what it includes.
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
    // Each includes the other. Only the second of the paths is that of a file, beside the shader.
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
        let said = stderr(&list(&sandbox));
        fs::write(&place, honest).unwrap();
        tests::text::assert_contains(&said, &[line, "broken"]);
    };
    // Before the body: two lines of the comment, two that are joined, two includes, and three lines that a condition leaves out.
    breaks(
        "blur.comp",
        &shader("int a = broken;\r\n"),
        "translated/in/blur.comp:10: ",
    );
    let joined = "#define JOINED(x) \\\n  (x) \\\n\nint a = broken;\n";
    breaks("lib/c.h", joined, "c.h:4");
}

/// Each copy names modules as seen from itself, so the compiler looks nowhere else first.
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
    // Only beside the shader is there a file of that name.
    write(
        "lib/other.slang",
        "__include\n\"noise\"; import \"nowhere\";\n",
    );
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    let script = "for word; do case \"$word\" in *.slang) \
                  /bin/cat \"$word\" \"${word%/*}/lib/other.slang\";; esac; done; exit 1";
    write_script(&sandbox.path("bin/slangc"), script);
    let said = stderr(&list(&sandbox));
    let parts = [
        "import lib.other; import \"lib/other\";",
        "import \"noise.slang\";",
        "#include \"own.h\"\n",
        "\"../noise\"; import \"nowhere\";",
    ];
    tests::text::assert_contains(&said, &parts);
    write("blur.slang", "import \"../nowhere\";\n");
    let said = stderr(&list(&sandbox));
    let parts = ["blur.slang:1: imports \"../nowhere\", which is no file"];
    tests::text::assert_contains(&said, &parts);
}

/// A shader, too, is a file of the folder.
#[test]
fn a_shader_is_no_link_out_of_the_folder() {
    let sandbox = Sandbox::new();
    let secret = sandbox.path("secret.comp");
    fs::write(&secret, "the secret\n").unwrap();
    write_pass(&sandbox, "blur.comp", "");
    let shader = sandbox.path("translated/blur.comp");
    _ = fs::remove_file(&shader);
    std::os::unix::fs::symlink(&secret, &shader).unwrap();
    let said = stderr(&list(&sandbox));
    let parts = ["translated/blur.comp: is a link to a file outside of the filter's folder"];
    tests::text::assert_contains(&said, &parts);
    assert!(!said.contains("the secret"), "{said}");
}
