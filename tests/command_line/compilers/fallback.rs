//! HLSL, which several compilers know: the next one where one fails, and the one that a pass chooses.

use std::fs;
use std::path::Path;

use tests::filter_folder::write_script;
use tests::root;
use tests::text::assert_contains;

use super::installed::find_program;
use super::{BINDINGS, COPY, list, write_pass};
use crate::sandbox::{Sandbox, assert_done, stderr, stdout};

/// Writes a pass over HLSL, and the texture after it.
fn write_hlsl(sandbox: &Sandbox, more: &str) {
    write_pass(sandbox, "blur.hlsl", &format!("{more}{BINDINGS}"));
    fs::write(sandbox.path("translated/copy.wgsl"), COPY).unwrap();
    fs::create_dir_all(sandbox.path("bin")).unwrap();
}

/// Writes a compiler that hands out a module, and logs that it ran.
fn write_compiler(sandbox: &Sandbox, program: &str, module: &Path) {
    let script = format!(
        "echo {program} >> {}\nfor word; do case \"$word\" in *.spv) /bin/cp {} \"$word\";; esac; done",
        sandbox.path("log.txt").display(),
        module.display()
    );
    write_script(&sandbox.path("bin").join(program), &script);
}

/// A `slangc` without one of its libraries, and a module that nothing here reads, do not keep working HLSL from working.
#[test]
fn a_compiler_that_fails_is_followed_by_the_next() {
    let module = fs::canonicalize(root().join("tests/fuzz/corpus/spirv/fastest")).unwrap();
    let sandbox = Sandbox::new();
    write_hlsl(&sandbox, "");
    let noise = "for n in 1 2 3 4 5 6 7 8 9; do echo \"note: $n ----------------------------------------------\"; done";
    let noise = format!("for m in 1 2 3 4 5 6 7 8 9 0; do {noise}; done");
    let failing = format!("{noise}\necho 'error 00100: failed to load slang-glslang'; exit 1");
    write_script(&sandbox.path("bin/slangc"), &failing);
    fs::write(sandbox.path("junk"), "no module").unwrap();
    write_compiler(&sandbox, "dxc", &sandbox.path("junk"));
    write_compiler(&sandbox, "glslangValidator", &module);
    let listed = list(&sandbox);
    assert_done(&listed);
    let said = stdout(&listed);
    let parts = [
        "blur.hlsl compiled by glslangValidator; slangc refuses it: error 00100: failed to load slang-glslang; dxc: ",
    ];
    let squeezed = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_contains(&squeezed, &parts);
    // Where all fail, each says why.
    fs::remove_file(sandbox.path("bin/glslangValidator")).unwrap();
    let said = stderr(&list(&sandbox));
    let parts = [
        "translated/blur.hlsl: slangc refuses it: error 00100: failed to load slang-glslang\n  | note: 1 --",
        " more lines\n  | dxc: ",
    ];
    assert_contains(&said, &parts);
    // What is wrong with filter.toml is said once.
    write_compiler(&sandbox, "slangc", &module);
    write_compiler(&sandbox, "dxc", &module);
    write_hlsl(&sandbox, "");
    let manifest = sandbox.path("translated/filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, text.replacen("unused = 0", "nobody = 0", 1)).unwrap();
    let said = stderr(&list(&sandbox));
    assert_eq!(said.matches("its member \"unused\"").count(), 1, "{said}");
    assert!(!said.contains("dxc"), "{said}");
}

#[test]
fn a_pass_chooses_its_compiler() {
    let module = fs::canonicalize(root().join("tests/fuzz/corpus/spirv/fastest")).unwrap();
    let sandbox = Sandbox::new();
    write_hlsl(&sandbox, "compiler = \"dxc\"\n");
    for program in ["slangc", "dxc", "glslangValidator"] {
        write_compiler(&sandbox, program, &module);
    }
    let listed = list(&sandbox);
    assert_done(&listed);
    assert!(stdout(&listed).contains("blur.hlsl compiled by dxc\n"));
    assert_eq!(
        fs::read_to_string(sandbox.path("log.txt")).unwrap(),
        "dxc\n"
    );
    fs::remove_file(sandbox.path("bin/dxc")).unwrap();
    let said = stderr(&list(&sandbox));
    assert_contains(&said, &["HLSL needs dxc on the PATH", "install dxc from"]);
    for (compiler, file, says) in [
        (
            "gcc",
            "blur.hlsl",
            "compiler = \"gcc\"; allowed for HLSL: slangc, dxc, glslangValidator",
        ),
        (
            "slangc",
            "blur.comp",
            "compiler = \"slangc\"; allowed for GLSL: glslangValidator",
        ),
        (
            "slangc",
            "copy.wgsl",
            "compiler = \"slangc\"; WGSL needs no compiler",
        ),
    ] {
        write_pass(&sandbox, file, &format!("compiler = \"{compiler}\"\n"));
        let said = stderr(&list(&sandbox));
        assert_contains(&said, &["translated/filter.toml:", says]);
    }
}

/// The HLSL of the guides, with a `slangc` that fails on it.
#[test]
fn glslang_compiles_what_a_broken_slangc_does_not() {
    let sandbox = Sandbox::new();
    let folder = sandbox.path("translated");
    fs::create_dir_all(&folder).unwrap();
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    let example = root().join("examples/first_blur/unity");
    for entry in fs::read_dir(example).unwrap() {
        let file = entry.unwrap();
        fs::copy(file.path(), folder.join(file.file_name())).unwrap();
    }
    let found = find_program("glslangValidator").expect("apt-get install glslang-tools");
    std::os::unix::fs::symlink(found, sandbox.path("bin/glslangValidator")).unwrap();
    write_script(
        &sandbox.path("bin/slangc"),
        "echo 'error: no glslang part'; exit 1",
    );
    let listed = list(&sandbox);
    assert_done(&listed);
    let said = stdout(&listed);
    assert!(
        said.contains("compiled by glslangValidator; slangc refuses it"),
        "{said}"
    );
}
