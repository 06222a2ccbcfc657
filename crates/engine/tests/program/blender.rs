//! Blender, a real renderer: its vectors against the tracer's, and its blur in a ranking. `make
//! prove` installs Debian's.

use std::process::Command;

use tests::text::assert_contains;
use tests::{root, scenes};

use super::export_gltf;
use super::import_gltf::model::{MODEL, Model};
use super::import_gltf::skinned;
use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Exports a shipped scene, and draws it in Blender with four sub-frames.
fn draw(scene: &str, options: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    let exported = export_gltf(&sandbox, scene, &["--subframes", "4"]);
    draw_exported(&sandbox, &exported, options);
    sandbox
}

/// Draws an exported scene in Blender, to the folder `capture`.
fn draw_exported(sandbox: &Sandbox, exported: &str, options: &str) {
    let mut command = Command::new("blender");
    command.args(["-b", "--python-exit-code", "1", "--python"]);
    command.arg(root().join("examples/blender/blender.py"));
    let line = format!("-- {exported} capture --size 96x54 --samples 4 {options}");
    command.args(split(&line)).current_dir(sandbox.path(""));
    let output = command.output().unwrap_or_else(|error| {
        panic!("blender does not start ({error}): apt-get install blender python3-numpy, as `make prove` does")
    });
    let said = stdout(&output) + &stderr(&output);
    assert!(output.status.success(), "blender: {said}");
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

#[test]
#[ignore = "prove: needs Blender"]
fn blender_draws_the_velocity_and_depth_that_the_import_of_a_gltf_file_has() {
    for (model, seconds, rate) in [(skinned(1), 1.0, 4), (Model::sliding(), 1.0, 24)] {
        let sandbox = Sandbox::new();
        model.write(&sandbox);
        let line = format!("engine import {MODEL} --time {seconds}s --fps {rate}");
        sandbox.done(&format!("{line} --out scenes/imported"));
        sandbox.done("engine export imported --gltf gltf");
        let original = format!("--original {MODEL} --at {seconds} --fps {rate}");
        draw_exported(
            &sandbox,
            "gltf/imported",
            &format!("{original} --blur none"),
        );
        let told = sandbox.done("engine audit capture --scene imported");
        assert_contains(&told, &["PASS: velocity and depth are right"]);
    }
}

/// Imports a glTF file, and measures the farthest that a vertex or an axis of the camera is from
/// Blender's, in metres or in parts of its distance from the origin.
fn measure_import(sandbox: &Sandbox, model: &str, seconds: f64, rate: f64) -> f64 {
    let line =
        format!("engine import {model} --time {seconds}s --fps {rate} --out scenes/imported");
    sandbox.done(&line);
    let mut command = Command::new("blender");
    command.args(["-b", "--python-exit-code", "1", "--python"]);
    command.arg(root().join("crates/engine/tests/program/blender_import.py"));
    let line = format!("-- {model} scenes/imported {seconds} {rate}");
    command.args(split(&line)).current_dir(sandbox.path(""));
    let output = command.output().unwrap();
    let said = stdout(&output) + &stderr(&output);
    let worst = said.lines().find_map(|line| line.strip_prefix("worst: "));
    worst
        .and_then(|worst| worst.parse().ok())
        .unwrap_or_else(|| panic!("blender: {said}"))
}

#[test]
#[ignore = "prove: needs Blender"]
fn blender_places_the_vertices_and_the_camera_of_a_gltf_file_where_the_import_does() {
    // Nodes with parents; morph targets; a moving camera.
    for scene in ["walker", "flag", "dolly"] {
        let sandbox = Sandbox::new();
        let model = export_gltf(&sandbox, scene, &[]) + "/scene.gltf";
        let worst = measure_import(&sandbox, &model, 2.0 / 24.0, 24.0);
        // Blender computes with 32 bits, and the vertices are metres from the origin.
        assert!(worst < 1e-5, "{scene}: {worst}");
    }
    for model in [skinned(1), Model::sliding()] {
        let sandbox = Sandbox::new();
        model.write(&sandbox);
        let worst = measure_import(&sandbox, MODEL, 1.0, 4.0);
        assert!(worst < 1e-5, "{worst}");
    }
}
