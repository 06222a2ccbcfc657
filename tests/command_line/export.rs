//! `export`: scenes as glTF.

use std::fs;

use engine::CaptureDescription;

use crate::sandbox::Sandbox;

#[test]
fn a_scene_becomes_a_folder_that_says_when_its_frame_is() {
    let sandbox = Sandbox::new();
    let text = sandbox.done("engine export plate --gltf gltf");
    assert!(text.contains("the frame is at 0.083333 s"), "{text}");
    for name in ["scene.gltf", "scene.bin", "sky.exr"] {
        assert!(sandbox.path("gltf/plate").join(name).exists(), "no {name}");
    }
    let manifest: serde_json::Value = sandbox.read_json("gltf/plate/manifest.json");
    assert_eq!(manifest["objects"][0], "background");
    assert_eq!(manifest["seconds_per_frame"].as_f64(), Some(1.0 / 24.0));
    let times = ["previous", "instant", "next"].map(|name| manifest[name].as_f64());
    assert_eq!(times, [1.0, 2.0, 3.0].map(|frame| Some(frame / 24.0)));
}

#[test]
fn an_export_says_when_to_draw_each_sub_frame_and_begins_the_capture_s_description() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --gltf gltf --subframes 4");
    let manifest: serde_json::Value = sandbox.read_json("gltf/plate/manifest.json");
    let times = manifest["subframes"]["centred"].as_array().unwrap();
    // The shutter is open for half a frame of 1/24 s around the frame at 2/24 s.
    for (time, part) in times.iter().zip([-0.1875, -0.0625, 0.0625, 0.1875]) {
        let difference = time.as_f64().unwrap() - (2.0 + part) / 24.0;
        assert!(difference.abs() < 1e-12, "{time}");
    }
    assert_eq!(times.len(), 4);
    let described = CaptureDescription::read(&sandbox.path("gltf/plate")).unwrap();
    assert_eq!(described.scene, Some("plate".parse().unwrap()));
    assert_eq!(described.exposure, Some(0.5));
    assert_eq!(described.subframes, Some(4));
    let parts = ["--subframes 5", "even numbers from 4 to 4096"];
    sandbox.refuse("engine export plate --subframes 5", &parts);
}

#[test]
fn an_unlit_export_is_the_scene_that_run_takes_as_unlit() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --unlit --gltf flagged");
    sandbox.done("engine export plate@unlit --gltf named");
    let read =
        |folder: &str| fs::read(sandbox.path(folder).join("plate@unlit/scene.gltf")).unwrap();
    assert_eq!(read("flagged"), read("named"));
    sandbox.done("truths render --scenes plate@unlit --size 32x18 --samples-per-pixel 16 --out r");
    assert!(sandbox.path("r/plate@unlit/truth_trailing.exr").is_file());
}
