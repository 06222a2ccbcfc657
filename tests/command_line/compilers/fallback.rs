//! HLSL, which several compilers accept: the next one if one fails, and a pass's choice.

use std::fs;

use tests::root;
use tests::text::assert_contains;

use super::installed::install_glslang;
use super::*;
use crate::sandbox::{Sandbox, assert_done, read_below, split, stdout};

/// Writes a pass over HLSL, and the texture after it.
fn write_hlsl(sandbox: &Sandbox, more: &str) {
    write_pass(sandbox, "blur.hlsl", &format!("{more}{BINDINGS}"));
    sandbox.put("translated/copy.wgsl", COPY);
}

/// Working HLSL still works if `slangc` lacks one of its libraries, or a module is unreadable here.
#[test]
fn a_compiler_that_fails_is_followed_by_the_next() {
    let module = find_module();
    let sandbox = Sandbox::new();
    write_hlsl(&sandbox, "");
    let noise = "for n in 1 2 3 4 5 6 7 8 9; do echo \"note: $n ----------------------------------------------\"; done";
    let noise = format!("for m in 1 2 3 4 5 6 7 8 9 0; do {noise}; done");
    let failing = format!("{noise}\necho 'error 00100: failed to load slang-glslang'; exit 1");
    write_compiler(&sandbox, "slangc", &failing);
    sandbox.put("junk", "no module");
    write_honest_compiler(&sandbox, "dxc", &sandbox.path("junk"));
    write_honest_compiler(&sandbox, "glslangValidator", &module);
    let listed = list(&sandbox);
    assert_done(&listed);
    let says = "blur.hlsl compiled by glslangValidator; slangc refuses it: error 00100: failed to load slang-glslang; dxc: ";
    assert_contains(&split(&stdout(&listed)).join(" "), &[says]);
    // If all fail, each error is shown.
    fs::remove_file(sandbox.path("bin/glslangValidator")).unwrap();
    let parts = [
        "translated/blur.hlsl: slangc refuses it: error 00100: failed to load slang-glslang\n  | note: 1 --",
        " more lines\n  | dxc: ",
    ];
    assert_contains(&refuse(&sandbox), &parts);
    // An error in filter.toml is reported once.
    write_honest_compiler(&sandbox, "slangc", &module);
    write_honest_compiler(&sandbox, "dxc", &module);
    let manifest = sandbox.path("translated/filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, text.replacen("unused = 0", "nobody = 0", 1)).unwrap();
    let said = refuse(&sandbox);
    assert_eq!(said.matches("its member \"unused\"").count(), 1, "{said}");
    assert!(!said.contains("dxc"), "{said}");
}

/// A shader, a compiler that does not compile it, and the rest of the message.
const OTHER_LANGUAGES: [(&str, &str, &str); 3] = [
    (
        "blur.hlsl",
        r#"compiler = "gcc""#,
        "; allowed for HLSL: slangc, dxc, glslangValidator",
    ),
    (
        "blur.comp",
        r#"compiler = "slangc""#,
        "; allowed for GLSL: glslangValidator",
    ),
    (
        "copy.wgsl",
        r#"compiler = "slangc""#,
        "; WGSL needs no compiler",
    ),
];

#[test]
fn a_pass_chooses_its_compiler() {
    let sandbox = Sandbox::new();
    write_hlsl(&sandbox, "compiler = \"dxc\"\n");
    for program in ["slangc", "dxc", "glslangValidator"] {
        write_honest_compiler(&sandbox, program, &find_module());
    }
    let listed = list(&sandbox);
    assert_done(&listed);
    assert_contains(&stdout(&listed), &["blur.hlsl compiled by dxc\n"]);
    assert_eq!(read_log(&sandbox), "dxc\n");
    fs::remove_file(sandbox.path("bin/dxc")).unwrap();
    let parts = ["HLSL needs dxc on the PATH", "install dxc from"];
    assert_contains(&refuse(&sandbox), &parts);
    for (file, compiler, allowed) in OTHER_LANGUAGES {
        write_pass(&sandbox, file, &format!("{compiler}\n"));
        let says = format!("{compiler}{allowed}");
        assert_contains(&refuse(&sandbox), &["translated/filter.toml:", &says]);
    }
}

/// The HLSL of the guides, with a `slangc` that fails on it.
#[test]
fn glslang_compiles_what_a_broken_slangc_does_not() {
    let sandbox = Sandbox::new();
    let example = root().join("examples/first_blur/unity");
    sandbox.write_files("translated", &read_below(&example));
    install_glslang(&sandbox);
    write_compiler(&sandbox, "slangc", "echo 'error: no glslang part'; exit 1");
    let listed = list(&sandbox);
    assert_done(&listed);
    let says = "compiled by glslangValidator; slangc refuses it";
    assert_contains(&stdout(&listed), &[says]);
}
