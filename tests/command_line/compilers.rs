//! Compilers of shading languages: those that are missing, and what the program makes of those that are there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tests::filter_folder::write_script;
use tests::root;

use crate::bench::{Bench, assert_done, stderr};

/// Writes a filter with one pass over a shader in that file.
fn write_pass(bench: &Bench, file: &str, more: &str) {
    let folder = bench.path("translated");
    fs::create_dir_all(&folder).unwrap();
    let manifest = format!(
        "name = \"translated\"\nsummary = \"A shader in another language.\"\nalignment = \"centred\"\n\n\
         [[texture]]\nname = \"tile_motion\"\nformat = \"rg32float\"\n\n[[pass]]\nshader = \"{file}\"\n{more}"
    );
    fs::write(folder.join("filter.toml"), manifest).unwrap();
    fs::write(folder.join(file), "the text of a shader\n").unwrap();
}

/// Lists the filter with no other programs on the PATH than those in `bin`.
fn list(bench: &Bench) -> Output {
    fs::create_dir_all(bench.path("bin")).unwrap();
    let mut command = bench.command(&["list", "--filter", "translated"]);
    command.env("PATH", bench.path("bin")).output().unwrap()
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
    let bench = Bench::new();
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
        write_pass(&bench, file, "");
        let listed = list(&bench);
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
        let bench = Bench::new();
        write_pass(&bench, file, BINDINGS);
        fs::write(bench.path("translated/copy.wgsl"), COPY).unwrap();
        fs::create_dir_all(bench.path("bin")).unwrap();
        let module = module.display();
        let script = format!(
            "case \"$*\" in {words}*) ;; *) echo \"called as $*\"; exit 3;; esac\n\
             for word; do case \"$word\" in *.spv) /bin/cp {module} \"$word\";; esac; done"
        );
        write_script(&bench.path("bin").join(compiler), &script);
        assert_done(&list(&bench));
    }
    let bench = Bench::new();
    write_pass(&bench, "blur.wesl", "conditions = [\"FAST\", \"FINE\"]\n");
    let wgsl = COPY.replace(
        "@group(0) @binding(1) var tile_motion: texture_2d<f32>;\n",
        "",
    );
    let wgsl = wgsl.replace("textureLoad(tile_motion, id.xy, 0)", "vec4<f32>()");
    fs::create_dir_all(bench.path("bin")).unwrap();
    fs::write(bench.path("compiled.wgsl"), wgsl).unwrap();
    let script = format!(
        "case \"$*\" in \"compile -D FAST -D FINE \"/*/blur.wesl) ;; *) echo \"called as $*\" >&2; exit 3;; esac\n\
         /bin/cat {}",
        bench.path("compiled.wgsl").display()
    );
    write_script(&bench.path("bin/wesl"), &script);
    let manifest = bench.path("translated/filter.toml");
    let text = fs::read_to_string(&manifest).unwrap();
    let without_texture = text.replace(
        "[[texture]]\nname = \"tile_motion\"\nformat = \"rg32float\"\n\n",
        "",
    );
    fs::write(&manifest, without_texture).unwrap();
    assert_done(&list(&bench));
}

#[cfg(unix)]
#[test]
fn what_a_compiler_says_is_shown_with_its_line() {
    let bench = Bench::new();
    write_pass(&bench, "blur.slang", "");
    fs::create_dir_all(bench.path("bin")).unwrap();
    // Slang puts the line in brackets.
    let script = "for word; do case \"$word\" in *.slang) echo \"$word(7): error 20001: unexpected token\" >&2;; esac; done\nexit 1";
    write_script(&bench.path("bin/slangc"), script);
    let said = stderr(&list(&bench));
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
    let bench = Bench::new();
    write_pass(&bench, "blur.wesl", "");
    fs::create_dir_all(bench.path("bin")).unwrap();
    let script = "printf '\\033[1m\\033[91merror\\033[0m: file not found\\n' >&2";
    write_script(&bench.path("bin/wesl"), script);
    let said = stderr(&list(&bench));
    assert!(
        said.contains("translated/blur.wesl: wesl refuses it: error: file not found"),
        "{said}"
    );
}

/// Finds a program on the PATH.
fn find_program(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates = std::env::split_paths(&folders).map(|folder| folder.join(name));
    candidates.find(|candidate| candidate.is_file())
}

/// Copies the fixtures of one language into the folder of a filter, whose head is that of the documented example.
fn write_fixture(bench: &Bench, language: &str, head: &str) {
    let folder = bench.path(language);
    let fixtures = root().join("tests/fixtures/shaders");
    fs::create_dir_all(folder.join("random")).unwrap();
    let passes = fs::read_to_string(fixtures.join(format!("{language}.toml"))).unwrap();
    fs::write(folder.join("filter.toml"), format!("{head}{passes}")).unwrap();
    let copied = [
        "centre_blur.hlsl",
        "noise.hlsli",
        "centre_blur.slang",
        "noise.slang",
        "centre_blur.wesl",
        "random/gradient.wesl",
        "random/constants.wesl",
    ];
    for file in copied {
        fs::copy(fixtures.join(file), folder.join(file)).unwrap();
    }
}

/// One filter in three languages, each through every compiler of it that is installed. `glslangValidator` always is.
#[cfg(unix)]
#[test]
fn each_compiler_makes_the_picture_that_wgsl_makes() {
    const README: &str = include_str!("../../shaders/README.md");
    let block = |language: &str| {
        let after = README.split_once(&format!("```{language}\n")).unwrap().1;
        after.split_once("```").unwrap().0
    };
    let bench = Bench::new();
    bench.write_filter("centre_blur", block("toml"), block("wgsl"));
    let head = block("toml").split_once("[[pass]]").unwrap().0;
    bench.execute(&[
        "render",
        "--quiet",
        "--out",
        "r",
        "--scenes",
        "plate",
        "--samples-per-pixel",
        "16",
        "--alignments",
        "centred",
    ]);
    let blur = |filter: &str, preset: &str, path: &Path| {
        let filter = format!("./{filter}:{preset}");
        let words = [
            "blur",
            "--filter",
            &filter,
            "--frame",
            "r/plate/frame.exr",
            "--frame-index",
            "3",
            "--out",
            "b.exr",
        ];
        let output = bench.command(&words).env("PATH", path).output().unwrap();
        assert_done(&output);
        frame::read_exr(&bench.path("b.exr"))
            .unwrap()
            .color("")
            .unwrap()
    };
    let mut tried = Vec::new();
    for (language, program) in [
        ("hlsl", "glslangValidator"),
        ("hlsl", "dxc"),
        ("hlsl", "slangc"),
        ("slang", "slangc"),
        ("wesl", "wesl"),
    ] {
        let Some(found) = find_program(program) else {
            println!("{program} is not on the PATH: {language} was not tried with it");
            continue;
        };
        let bin = bench.path(&format!("bin_{program}"));
        fs::create_dir_all(&bin).unwrap();
        _ = std::os::unix::fs::symlink(found, bin.join(program));
        write_fixture(&bench, language, head);
        for preset in ["fast", "fine"] {
            let expected = blur("centre_blur", preset, &bin);
            let found = blur(language, preset, &bin);
            let pixels = expected.pixels.iter().zip(&found.pixels);
            let differences = pixels.flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
            let difference = differences.fold(0.0, f32::max);
            assert!(
                difference < 1e-5,
                "{language}, {program}, {preset}: {difference}"
            );
        }
        tried.push(program);
    }
    assert!(
        tried.contains(&"glslangValidator"),
        "glslangValidator is not on the PATH: apt-get install glslang-tools"
    );
}

/// What a stranger's shader includes comes from its own folder.
#[cfg(unix)]
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
