//! Blender, a real renderer: its vectors against the tracer's, and its blur in a ranking. `make
//! prove` installs Debian's.

use std::process::Command;

use tests::text::assert_contains;
use tests::{root, scenes};

use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Exports a shipped scene, and draws it in Blender with four sub-frames.
fn draw(scene: &str, options: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    let folder = scenes().display().to_string();
    let words = split("engine export --subframes 4 --gltf gltf --scenes-dir");
    sandbox.execute(&[&words[..], &[&folder, scene]].concat());
    let mut command = Command::new("blender");
    command.args(["-b", "--python-exit-code", "1", "--python"]);
    command.arg(root().join("examples/blender/blender.py"));
    let line = format!("-- gltf/{scene} capture --size 96x54 --samples 4 {options}");
    command.args(split(&line)).current_dir(sandbox.path(""));
    let output = command.output().unwrap_or_else(|error| {
        panic!("blender does not start ({error}): apt-get install blender python3-numpy, as `make prove` does")
    });
    let said = stdout(&output) + &stderr(&output);
    assert!(output.status.success(), "blender: {said}");
    sandbox
}

/// Runs a command on the shipped scenes; it must succeed.
fn run(sandbox: &Sandbox, line: &str) -> String {
    let folder = scenes().display().to_string();
    sandbox.execute(&[&split(line)[..], &["--scenes-dir", &folder]].concat())
}

#[test]
#[ignore = "prove: needs Blender"]
fn blender_s_vectors_are_right_and_its_blur_is_ranked_on_its_own_frames() {
    let sandbox = draw("fan", "");
    let told = run(&sandbox, "engine audit capture");
    assert_contains(&told, &["PASS", "fan drawn by Blender "]);
    let told = run(&sandbox, "engine ingest capture");
    let parts = ["mean of 4 sub-frames, centred shutter", "objects: "];
    assert_contains(&told, &parts);
    let line =
        "run --scenes fan,out/engine/capture --samples-per-pixel 16 --filter jimenez:slides_2014";
    let told = run(&sandbox, line);
    let parts = ["whose frames", "_Vector_Blur", "jimenez:slides_2014"];
    assert_contains(&told, &parts);
}

#[test]
#[ignore = "prove: needs Blender"]
fn blender_shows_the_colours_of_an_unlit_scene_without_sub_frames() {
    // Textures times colours, and a train.
    let sandbox = draw("fence@unlit", "--blur none");
    assert!(!sandbox.path("capture/subframes").exists());
    let told = run(&sandbox, "engine audit capture");
    assert_contains(&told, &["PASS: velocity, depth and colour are right"]);
}
