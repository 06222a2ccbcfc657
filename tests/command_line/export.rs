//! `export`: scenes as glTF.

use std::fs;

use crate::sandbox::Sandbox;

#[test]
fn a_scene_becomes_a_folder_that_says_when_its_frame_is() {
    let sandbox = Sandbox::new();
    let text = sandbox.done("engine export plate --gltf gltf");
    assert!(text.contains("the frame is at 0.083333 s"), "{text}");
    for name in ["scene.gltf", "scene.bin", "sky.exr", "manifest.json"] {
        assert!(sandbox.path("gltf/plate").join(name).exists(), "no {name}");
    }
    let manifest: serde_json::Value = sandbox.read_json("gltf/plate/manifest.json");
    assert_eq!(manifest["objects"][0], "background");
    assert_eq!(manifest["seconds_per_frame"].as_f64(), Some(1.0 / 24.0));
    let times = ["previous", "instant", "next"].map(|name| manifest[name].as_f64());
    assert_eq!(times, [1.0, 2.0, 3.0].map(|frame| Some(frame / 24.0)));
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
