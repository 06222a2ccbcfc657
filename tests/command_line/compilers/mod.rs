//! Compilers of shading languages: missing ones, and how the program uses existing ones.

#[cfg(unix)]
mod fallback;
#[cfg(unix)]
mod includes;
#[cfg(unix)]
mod installed;
#[cfg(target_os = "linux")]
mod stopped;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tests::filter_folder::write_script;
use tests::root;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, stderr};

/// Writes a filter with one pass over a shader in that file.
fn write_pass(sandbox: &Sandbox, file: &str, more: &str) {
    let folder = sandbox.path("translated");
    fs::create_dir_all(&folder).unwrap();
    let manifest = format!(
        "name = \"translated\"\nsummary = \"A shader in another language.\"\nalignment = \"centred\"\n\n\
         [[texture]]\nname = \"tile_motion\"\nformat = \"rg32float\"\n\n[[pass]]\nshader = \"{file}\"\n{more}"
    );
    fs::write(folder.join("filter.toml"), manifest).unwrap();
    fs::write(folder.join(file), "the text of a shader\n").unwrap();
}

/// Lists the filter with only the programs in `bin` on the PATH.
fn list(sandbox: &Sandbox) -> Output {
    let mut command = sandbox.command(&["list", "--filter", "translated"]);
    command.env("PATH", sandbox.path("bin")).output().unwrap()
}

/// Lists the filter, which must be refused; returns the message.
#[track_caller]
fn refuse(sandbox: &Sandbox) -> String {
    let listed = list(sandbox);
    let said = stderr(&listed);
    assert_eq!(listed.status.code(), Some(2), "{said}");
    said
}

/// Writes a compiler that is a script.
fn write_compiler(sandbox: &Sandbox, program: &str, lines: &str) {
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    write_script(&sandbox.path("bin").join(program), lines);
}

/// Finds a precompiled module.
fn find_module() -> PathBuf {
    fs::canonicalize(root().join("tests/fuzz/corpus/spirv/fastest")).unwrap()
}

/// Writes a compiler that outputs a module, and logs that it ran.
fn write_honest_compiler(sandbox: &Sandbox, program: &str, module: &Path) {
    let script = format!(
        "echo {program} >> {}\nfor word; do case \"$word\" in *.spv) /bin/cp {} \"$word\";; esac; done",
        sandbox.path("log.txt").display(),
        module.display()
    );
    write_compiler(sandbox, program, &script);
}

fn read_log(sandbox: &Sandbox) -> String {
    sandbox.text("log.txt")
}

/// Bindings of the module that fake compilers output.
const BINDINGS: &str = include_str!("../../fixtures/shaders/fastest_pass.toml");
/// The pass after it.
const COPY: &str = include_str!("../../fixtures/shaders/copy.wgsl");

/// A shader, and parts of the message without a compiler for it.
const WAYS_OUT: [(&str, &[&str]); 4] = [
    (
        "blur.comp",
        &[
            "GLSL needs glslangValidator on the PATH",
            "apt-get install glslang-tools",
        ],
    ),
    (
        "blur.slang",
        &["Slang needs slangc on the PATH", "or compile it to SPIR-V"],
    ),
    (
        "blur.hlsl",
        &[
            "HLSL needs slangc or dxc or glslangValidator on the PATH",
            "apt-get install glslang-tools",
        ],
    ),
    (
        "blur.wesl",
        &[
            "WESL needs wesl on the PATH",
            "cargo install wesl-cli@0.4.0",
        ],
    ),
];

#[test]
fn a_language_without_its_compiler_names_the_way_out() {
    let sandbox = Sandbox::new();
    for (file, parts) in WAYS_OUT {
        write_pass(&sandbox, file, "");
        assert_contains(&refuse(&sandbox), parts);
    }
}

/// A shader, its compiler, and the words of the call as a shell's pattern.
const CALLS: [(&str, &str, &str); 3] = [
    (
        "blur.slang",
        "slangc",
        "*-lang?slang*-target?spirv*-entry?main*-stage?compute*-o?",
    ),
    ("blur.hlsl", "dxc", "*-spirv*-T?cs_6_0*-E?main*-Fo?"),
    (
        "blur.hlsl",
        "slangc",
        "*-target?spirv*-entry?main*-stage?compute*-o?",
    ),
];

/// The compilers here are scripts: they output a precompiled module, if they are called correctly.
#[cfg(unix)]
#[test]
fn slang_hlsl_and_wesl_go_through_their_compilers() {
    let module = find_module().display().to_string();
    for (file, compiler, words) in CALLS {
        let sandbox = Sandbox::new();
        write_pass(&sandbox, file, BINDINGS);
        sandbox.put("translated/copy.wgsl", COPY);
        let script = format!(
            "case \"$*\" in {words}*) ;; *) echo \"called as $*\"; exit 3;; esac\n\
             for word; do case \"$word\" in *.spv) /bin/cp {module} \"$word\";; esac; done"
        );
        write_compiler(&sandbox, compiler, &script);
        assert_done(&list(&sandbox));
    }
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.wesl", "conditions = [\"FAST\", \"FINE\"]\n");
    let text = "@if(FAST) const taps = 4;\n@if(FINE) const step = 1;\n";
    sandbox.put("translated/blur.wesl", text);
    let manifest = sandbox.path("translated/filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let (texture, binding) = (
        "[[texture]]\nname = \"tile_motion\"\nformat = \"rg32float\"\n\n",
        "@group(0) @binding(1) var tile_motion: texture_2d<f32>;\n",
    );
    fs::write(&manifest, text.replace(texture, "")).unwrap();
    let wgsl = COPY.replace(binding, "");
    let wgsl = wgsl.replace("textureLoad(tile_motion, id.xy, 0)", "vec4<f32>()");
    sandbox.put("compiled.wgsl", wgsl);
    let script = format!(
        "case \"$*\" in \"compile -D FAST -D FINE \"/*/blur.wesl) ;; *) echo \"called as $*\" >&2; exit 3;; esac\n\
         /bin/cat {}",
        sandbox.path("compiled.wgsl").display()
    );
    write_compiler(&sandbox, "wesl", &script);
    assert_done(&list(&sandbox));
}

/// Two passes over one shader: its compiler runs once, and again only after changes of its input.
#[cfg(unix)]
#[test]
fn a_compiler_runs_once_for_each_content() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", BINDINGS);
    let folder = sandbox.path("translated");
    let manifest = fs::read_to_string(folder.join("filter.toml")).unwrap();
    let (head, passes) = manifest.split_once("[[pass]]").unwrap();
    let (first, rest) = passes.split_once("[[pass]]").unwrap();
    // The third pass has another text.
    let third = first.replace("blur.slang", "other.slang");
    let passes = [head, first, first, &third, rest].join("[[pass]]");
    for (name, text) in [
        ("filter.toml", passes.as_str()),
        ("other.slang", "another text of a shader\n"),
        ("copy.wgsl", COPY),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    write_honest_compiler(&sandbox, "slangc", &find_module());
    assert_done(&list(&sandbox));
    assert_eq!(read_log(&sandbox), "slangc\nslangc\n");
}

#[cfg(unix)]
#[test]
fn what_a_compiler_says_is_shown_with_its_line() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", "");
    // Slang puts the line in brackets.
    let script = "for word; do case \"$word\" in *.slang) echo \"$word(7): error 20001: unexpected token\" >&2;; esac; done\nexit 1";
    write_compiler(&sandbox, "slangc", script);
    let parts = [
        "translated/blur.slang:7: slangc refuses it: ",
        "translated/blur.slang(7): error 20001: unexpected token",
    ];
    assert_contains(&refuse(&sandbox), &parts);
    // `wesl` 0.4 exits with 0 if it finds no file, and prints in colours.
    write_pass(&sandbox, "blur.wesl", "");
    let script = "printf '\\033[1m\\033[91merror\\033[0m: file not found\\n' >&2";
    write_compiler(&sandbox, "wesl", script);
    let says = "translated/blur.wesl: wesl refuses it: error: file not found";
    assert_contains(&refuse(&sandbox), &[says]);
}
