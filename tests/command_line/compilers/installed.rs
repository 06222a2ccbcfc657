//! The installed compilers: each makes the same picture as WGSL.

use std::fs;
use std::path::{Path, PathBuf};

use tests::root;
use tests::text::code_block;

use crate::conventions::largest_difference;
use crate::sandbox::{Sandbox, assert_done, read_below, split};

/// Finds a program on the PATH.
fn find_program(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates = std::env::split_paths(&folders).map(|folder| folder.join(name));
    candidates.find(|candidate| candidate.is_file())
}

/// Puts the real glslangValidator, and nothing else, on the bench's PATH.
pub fn install_glslang(sandbox: &Sandbox) {
    let glslang = find_program("glslangValidator").expect("apt-get install glslang-tools");
    fs::create_dir_all(sandbox.path("bin")).unwrap();
    std::os::unix::fs::symlink(glslang, sandbox.path("bin/glslangValidator")).unwrap();
}

/// Copies the fixtures into the folder of a filter in one language, with the documented example's
/// head.
fn write_fixture(sandbox: &Sandbox, language: &str, head: &str) {
    let fixtures = root().join("tests/fixtures/shaders");
    sandbox.write_files(language, &read_below(&fixtures));
    let passes = fs::read_to_string(fixtures.join(format!("{language}.toml"))).unwrap();
    let manifest = sandbox.path(language).join("filter.toml");
    fs::write(manifest, format!("{head}{passes}")).unwrap();
}

/// One filter in three languages, each translated by every installed compiler for it.
/// `glslangValidator` is always installed.
#[test]
fn each_compiler_makes_the_picture_that_wgsl_makes() {
    const README: &str = include_str!("../../../shaders/README.md");
    let block = |language: &str| code_block(README, &format!("```{language}\n"));
    let sandbox = Sandbox::new();
    sandbox.write_filter("centre_blur", block("toml"), block("c"));
    let head = block("toml").split_once("[[pass]]").unwrap().0;
    let words = "truths render --quiet --out r --scenes plate --samples-per-pixel 16";
    sandbox.done(&format!("{words} --alignments centred"));
    let blur = |filter: &str, path: &Path| {
        let words = "engine blur --frame r/plate/frame.exr --frame-index 3 --out b.exr --filter";
        let words = [split(words), vec![filter]].concat();
        let output = sandbox.command(&words).env("PATH", path).output().unwrap();
        assert_done(&output);
        sandbox.read_color("b.exr")
    };
    let mut tried = Vec::new();
    for (language, program) in [
        ("hlsl", "glslangValidator"),
        ("hlsl", "dxc"),
        ("hlsl", "slangc"),
        ("slang", "slangc"),
        ("wesl", "wesl"),
    ] {
        let Some(compiler) = find_program(program) else {
            println!("{program} is not on the PATH: {language} was not tried with it");
            continue;
        };
        let bin = sandbox.path(&format!("bin_{program}"));
        fs::create_dir_all(&bin).unwrap();
        _ = std::os::unix::fs::symlink(compiler, bin.join(program));
        write_fixture(&sandbox, language, head);
        for preset in ["fast", "fine"] {
            let [expected, actual] =
                ["centre_blur", language].map(|filter| blur(&format!("./{filter}:{preset}"), &bin));
            let difference = largest_difference(&expected, &actual);
            let tried = format!("{language}, {program}, {preset}");
            assert!(difference < 1e-5, "{tried}: {difference}");
        }
        tried.push(program);
    }
    assert!(
        tried.contains(&"glslangValidator"),
        "glslangValidator is not on the PATH: apt-get install glslang-tools"
    );
}
