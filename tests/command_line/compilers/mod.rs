//! Compilers of shading languages: those that are missing, and what the program makes of those that are there.

#[cfg(unix)]
mod fallback;
#[cfg(unix)]
mod includes;
#[cfg(unix)]
mod installed;

use std::fs;
use std::path::Path;
use std::process::Output;

use tests::filter_folder::write_script;
use tests::root;

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

/// Lists the filter with no other programs on the PATH than those in `bin`.
fn list(sandbox: &Sandbox) -> Output {
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    let mut command = sandbox.command(&["list", "--filter", "translated"]);
    command.env("PATH", sandbox.path("bin")).output().unwrap()
}

/// Bindings of the module that fake compilers hand out.
const BINDINGS: &str = r#"entry = "main"
over = "tile_motion"

[[pass.binding]]
binding = 0
texture = "velocity"
sampler = "nearest"

[[pass.binding]]
set = 1
binding = 3
texture = "tile_motion"

[[pass.binding]]
push_constants = true
values = { picture = ["width", "height"], side = 8, unused = 0 }

[[pass]]
shader = "copy.wgsl"
"#;

/// The pass after it.
const COPY: &str = r"
@group(0) @binding(0) var color: texture_2d<f32>;
@group(0) @binding(1) var tile_motion: texture_2d<f32>;
@group(0) @binding(2) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if all(id.xy < textureDimensions(color)) {
        let motion = textureLoad(tile_motion, id.xy, 0);
        textureStore(output, id.xy, textureLoad(color, id.xy, 0) + 0.001 * motion);
    }
}
";

#[test]
fn a_language_without_its_compiler_names_the_way_out() {
    let sandbox = Sandbox::new();
    for (file, parts) in [
        (
            "blur.comp",
            [
                "GLSL needs glslangValidator on the PATH",
                "apt-get install glslang-tools",
            ],
        ),
        (
            "blur.slang",
            ["Slang needs slangc on the PATH", "or compile it to SPIR-V"],
        ),
        (
            "blur.hlsl",
            [
                "HLSL needs slangc or dxc or glslangValidator on the PATH",
                "apt-get install glslang-tools",
            ],
        ),
        (
            "blur.wesl",
            [
                "WESL needs wesl on the PATH",
                "cargo install wesl-cli@0.4.0",
            ],
        ),
    ] {
        write_pass(&sandbox, file, "");
        let listed = list(&sandbox);
        assert_eq!(listed.status.code(), Some(2), "{listed:?}");
        for part in parts {
            assert!(stderr(&listed).contains(part), "{}", stderr(&listed));
        }
    }
}

/// The compilers here are scripts: they hand out a module that was compiled before, if they are called as they should be.
#[cfg(unix)]
#[test]
fn slang_hlsl_and_wesl_go_through_their_compilers() {
    let module = root().join("tests/fuzz/corpus/spirv/fastest");
    let module = fs::canonicalize(module).unwrap();
    // (file, compiler, words that it must get, hands out)
    let cases: [(&str, &str, &str, &Path); 3] = [
        (
            "blur.slang",
            "slangc",
            "*-lang?slang*-target?spirv*-entry?main*-stage?compute*-o?",
            &module,
        ),
        (
            "blur.hlsl",
            "dxc",
            "*-spirv*-T?cs_6_0*-E?main*-Fo?",
            &module,
        ),
        (
            "blur.hlsl",
            "slangc",
            "*-target?spirv*-entry?main*-stage?compute*-o?",
            &module,
        ),
    ];
    for (file, compiler, words, module) in cases {
        let sandbox = Sandbox::new();
        write_pass(&sandbox, file, BINDINGS);
        fs::write(sandbox.path("translated/copy.wgsl"), COPY).unwrap();
        fs::create_dir_all(sandbox.path("bin")).unwrap();
        let module = module.display();
        let script = format!(
            "case \"$*\" in {words}*) ;; *) echo \"called as $*\"; exit 3;; esac\n\
             for word; do case \"$word\" in *.spv) /bin/cp {module} \"$word\";; esac; done"
        );
        write_script(&sandbox.path("bin").join(compiler), &script);
        assert_done(&list(&sandbox));
    }
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.wesl", "conditions = [\"FAST\", \"FINE\"]\n");
    let wgsl = COPY.replace(
        "@group(0) @binding(1) var tile_motion: texture_2d<f32>;\n",
        "",
    );
    let wgsl = wgsl.replace("textureLoad(tile_motion, id.xy, 0)", "vec4<f32>()");
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    fs::write(sandbox.path("compiled.wgsl"), wgsl).unwrap();
    let script = format!(
        "case \"$*\" in \"compile -D FAST -D FINE \"/*/blur.wesl) ;; *) echo \"called as $*\" >&2; exit 3;; esac\n\
         /bin/cat {}",
        sandbox.path("compiled.wgsl").display()
    );
    write_script(&sandbox.path("bin/wesl"), &script);
    let manifest = sandbox.path("translated/filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let without_texture = text.replace(
        "[[texture]]\nname = \"tile_motion\"\nformat = \"rg32float\"\n\n",
        "",
    );
    fs::write(&manifest, without_texture).unwrap();
    assert_done(&list(&sandbox));
}

/// Two passes over one shader: its compiler runs once, and again only for what changes its input.
#[cfg(unix)]
#[test]
fn a_compiler_runs_once_for_each_content() {
    let module = fs::canonicalize(root().join("tests/fuzz/corpus/spirv/fastest")).unwrap();
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", BINDINGS);
    let folder = sandbox.path("translated");
    let manifest = fs::read_to_string(folder.join("filter.toml")).unwrap();
    let (head, passes) = manifest.split_once("[[pass]]").unwrap();
    let (first, rest) = passes.split_once("[[pass]]").unwrap();
    // The third pass has another text.
    let third = first.replace("blur.slang", "other.slang");
    let passes = [head, first, first, &third, rest].join("[[pass]]");
    fs::write(folder.join("filter.toml"), passes).unwrap();
    fs::write(folder.join("other.slang"), "another text of a shader\n").unwrap();
    fs::write(folder.join("copy.wgsl"), COPY).unwrap();
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    let log = sandbox.path("log.txt");
    let script = format!(
        "echo called >> {}\nfor word; do case \"$word\" in *.spv) /bin/cp {} \"$word\";; esac; done",
        log.display(),
        module.display()
    );
    write_script(&sandbox.path("bin/slangc"), &script);
    assert_done(&list(&sandbox));
    assert_eq!(fs::read_to_string(log).unwrap(), "called\ncalled\n");
}

#[cfg(unix)]
#[test]
fn what_a_compiler_says_is_shown_with_its_line() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", "");
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    // Slang puts the line in brackets.
    let script = "for word; do case \"$word\" in *.slang) echo \"$word(7): error 20001: unexpected token\" >&2;; esac; done\nexit 1";
    write_script(&sandbox.path("bin/slangc"), script);
    let said = stderr(&list(&sandbox));
    assert!(
        said.contains("translated/blur.slang:7: slangc refuses it: "),
        "{said}"
    );
    assert!(
        said.contains("translated/blur.slang(7): error 20001: unexpected token"),
        "{said}"
    );
}

/// `wesl` 0.4 ends with exit code 0 where it finds no file, and prints in colours.
#[cfg(unix)]
#[test]
fn a_compiler_that_makes_nothing_has_failed() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.wesl", "");
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    let script = "printf '\\033[1m\\033[91merror\\033[0m: file not found\\n' >&2";
    write_script(&sandbox.path("bin/wesl"), script);
    let said = stderr(&list(&sandbox));
    assert!(
        said.contains("translated/blur.wesl: wesl refuses it: error: file not found"),
        "{said}"
    );
}
