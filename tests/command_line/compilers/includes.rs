//! What a shader includes, from its own folder and from nowhere else.

use std::fs;

use tests::filter_folder::write_script;

use super::{list, write_pass};
use crate::bench::{Bench, stderr};

/// What a stranger's shader includes comes from its own folder.
#[test]
fn nothing_outside_of_the_folder_is_included() {
    let bench = Bench::new();
    fs::write(bench.path("secret.txt"), "the secret\n").unwrap();
    let secret = bench.path("secret.txt").display().to_string();
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
        let folder = bench.path("translated");
        _ = fs::remove_dir_all(&folder);
        write_pass(&bench, file, "");
        fs::write(folder.join(file), &text).unwrap();
        fs::write(folder.join("own.h"), format!("#include \"{secret}\"\n")).unwrap();
        std::os::unix::fs::symlink(&secret, folder.join("link.h")).unwrap();
        std::os::unix::fs::symlink(bench.path(""), folder.join("linked")).unwrap();
        fs::create_dir_all(bench.path("bin")).unwrap();
        // A compiler that would tell.
        for program in ["glslangValidator", "slangc"] {
            write_script(&bench.path("bin").join(program), "echo the secret; exit 1");
        }
        let listed = list(&bench);
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
        let folder = bench.path("translated");
        _ = fs::remove_dir_all(&folder);
        write_pass(&bench, file, "");
        std::os::unix::fs::symlink(&secret, folder.join(link)).unwrap();
        write_script(&bench.path("bin/wesl"), "echo the secret; exit 1");
        let said = stderr(&list(&bench));
        assert!(
            said.contains(&format!("translated/{link}: is a link")),
            "{said}"
        );
    }
}

/// A compiler looks for a file in the folders of all files that are being included.
#[test]
fn no_folder_of_an_includer_leads_outside() {
    let bench = Bench::new();
    fs::write(bench.path("secret.txt"), "the secret\n").unwrap();
    let folder = bench.path("translated");
    fs::create_dir_all(folder.join("p/q/r/s")).unwrap();
    write_pass(&bench, "p/q/blur.comp", "");
    for (file, includes) in [
        ("p/q/blur.comp", "../../top.h"),
        ("top.h", "p/q/r/s/deep.h"),
        // From p/q/r/s and from p/q it stays within, from the folder of top.h it does not.
        ("p/q/r/s/deep.h", "../../secret.txt"),
    ] {
        let text = format!("#include \"{includes}\"\n");
        fs::write(folder.join(file), text).unwrap();
    }
    fs::create_dir_all(bench.path("bin")).unwrap();
    write_script(
        &bench.path("bin/glslangValidator"),
        "echo the secret; exit 1",
    );
    let said = stderr(&list(&bench));
    let parts = [
        "translated/p/q/r/s/deep.h:1: ",
        "outside of the filter's folder",
    ];
    tests::text::assert_contains(&said, &parts);
    assert!(!said.contains("the secret"), "{said}");
}

/// A shader, too, is a file of the folder.
#[test]
fn a_shader_is_no_link_out_of_the_folder() {
    let bench = Bench::new();
    let secret = bench.path("secret.comp");
    fs::write(&secret, "the secret\n").unwrap();
    write_pass(&bench, "blur.comp", "");
    let shader = bench.path("translated/blur.comp");
    _ = fs::remove_file(&shader);
    std::os::unix::fs::symlink(&secret, &shader).unwrap();
    let said = stderr(&list(&bench));
    let parts = ["translated/blur.comp: is a link to a file outside of the filter's folder"];
    tests::text::assert_contains(&said, &parts);
    assert!(!said.contains("the secret"), "{said}");
}
