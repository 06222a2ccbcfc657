//! A filter that `new` begins.

use std::fs;

use tests::root;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_same_files, read_below, stderr};

/// A fullscreen pass, tiles, and a kernel.
const SOME: [&str; 3] = ["three", "godot_tiles", "wgsl"];

/// Examples that need no compiler which a machine may lack.
const EXAMPLES: [&str; 11] = [
    "bevy",
    "glsl_fragment",
    "godot",
    "godot_tiles",
    "spirv",
    "three",
    "unity",
    "unity_hdrp",
    "unity_urp",
    "unreal",
    "wgsl",
];

#[test]
fn an_example_becomes_a_filter_of_the_user_s_name_that_runs() {
    assert_run(&SOME);
}

#[test]
#[ignore = "prove: all examples"]
fn each_example_becomes_a_filter_of_the_user_s_name_that_runs() {
    assert_run(&EXAMPLES);
}

fn assert_run(examples: &[&str]) {
    let sandbox = Sandbox::of(&Vec::new());
    for example in examples {
        let name = format!("my_{example}");
        let printed = sandbox.done(&format!("new mine/{name} --from {example}"));
        let next = format!(
            "next: shuttertruth run sliding_panel fan railing --filter ./mine/{name} --size"
        );
        let listed = format!("\n  {name}  (shutter: trailing)\n");
        let written = format!("written: ./mine/{name}, from {example}\n");
        assert_contains(&printed, &[&written, &listed, &next]);
    }
    // The next command, made quick.
    let filters: Vec<String> = examples
        .iter()
        .map(|example| format!("./mine/my_{example}"))
        .collect();
    let filters = filters.join(",");
    let quick = "--size 64x32 --samples-per-pixel 16 --quiet";
    let ranking = sandbox.done(&format!("run fan --filter {filters},identity {quick}"));
    assert!(
        examples
            .iter()
            .all(|example| ranking.contains(&format!("my_{example}:default")))
    );
}

#[test]
fn an_example_under_its_own_name_is_the_repository_s() {
    let sandbox = Sandbox::of(&Vec::new());
    for (name, example) in [("my_blur", "wgsl"), ("unity_urp_blur", "unity_urp")] {
        sandbox.done(&format!("new {name} --from {example}"));
        let shipped = read_below(&root().join("examples/first_blur").join(example));
        assert_same_files(&read_below(&sandbox.path(name)), &shipped);
    }
}

#[test]
fn new_overwrites_nothing_and_names_what_it_allows() {
    let sandbox = Sandbox::of(&Vec::new());
    fs::create_dir(sandbox.path("my_blur")).unwrap();
    sandbox.refuse_each(
        "new",
        &[
            ("my_blur --from wgsl", &["my_blur exists", "a new folder"]),
            ("My-Blur --from wgsl", &["\"My-Blur\"", "a-z, 0-9 and _"]),
            ("mine --from unrael", &["'unrael'", "unreal", "godot"]),
            ("mine", &["--from <EXAMPLE>"]),
        ],
    );
    assert_eq!(read_below(&sandbox.path("")), Vec::new());
}

/// Without its compiler, an example is written, and the message says what to install.
#[test]
fn a_missing_compiler_is_named_after_the_files_are_written() {
    let sandbox = Sandbox::of(&Vec::new());
    let mut command = sandbox.command(&["new", "mine", "--from", "godot"]);
    let output = command.env("PATH", "").output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_contains(&stderr(&output), &["mine/blur.glsl", "glslangValidator"]);
    assert!(sandbox.path("mine/filter.toml").is_file());
}
