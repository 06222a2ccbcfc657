//! `export`: scenes as glTF.

use std::fs;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stdout};

#[test]
fn a_scene_becomes_a_folder_that_says_when_its_frame_is() {
    let sandbox = Sandbox::new();
    let output = sandbox.shuttertruth(&split("engine export plate --gltf gltf"));
    assert_done(&output);
    let text = stdout(&output);
    assert!(text.contains("the frame is at 0.083333 s"), "{text}");
    for name in ["scene.gltf", "scene.bin", "sky.exr", "manifest.json"] {
        assert!(sandbox.path("gltf/plate").join(name).exists(), "no {name}");
    }
    let manifest = fs::read_to_string(sandbox.path("gltf/plate/manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["objects"][0], "background");
    assert_eq!(manifest["seconds_per_frame"].as_f64(), Some(1.0 / 24.0));
}

#[test]
fn an_unlit_export_is_the_scene_that_run_takes_as_unlit() {
    let sandbox = Sandbox::new();
    let flagged = sandbox.shuttertruth(&split("engine export plate --unlit --gltf flagged"));
    assert_done(&flagged);
    assert_done(&sandbox.shuttertruth(&split("engine export plate@unlit --gltf named")));
    let read =
        |folder: &str| fs::read(sandbox.path(folder).join("plate@unlit/scene.gltf")).unwrap();
    assert_eq!(read("flagged"), read("named"));
    let render = "truths render --scenes plate@unlit --size 32x18 --samples-per-pixel 16 --out r";
    assert_done(&sandbox.shuttertruth(&split(render)));
    assert!(sandbox.path("r/plate@unlit/truth_trailing.exr").is_file());
    let variant = sandbox.shuttertruth(&split("engine export plate@fast --unlit"));
    assert_refused(&variant, 2, &["--unlit: plate@fast is a variant"]);
}

#[test]
fn scenes_that_are_not_there_and_folders_that_are_files_are_refused() {
    let sandbox = Sandbox::new();
    assert_refused(
        &sandbox.shuttertruth(&split("engine export plait --gltf gltf")),
        2,
        &["plait", "plate"],
    );
    fs::write(sandbox.path("taken"), "").unwrap();
    assert_refused(
        &sandbox.shuttertruth(&split("engine export plate --gltf taken")),
        2,
        &["taken"],
    );
}
