//! The variant `unlit` of every scene: surfaces send out their own colours, and no light falls on them.

use std::fs;
use std::ops::ControlFlow;

use engine::export_gltf;
use frame::ColorSampling;
use tests::scenes;
use tracer::{RenderSettings, Scene, list_scenes, load_scene, trace_frame};

/// Renders colour at the pixels' centres, without a lens, which has noise of its own.
fn render(scene: &Scene, seed: u64) -> frame::Image {
    let mut settings = RenderSettings {
        width: 48,
        height: 27,
        samples_per_pixel: 4,
        seed,
        ..RenderSettings::default()
    };
    settings.options.color = ColorSampling::Point;
    let sharp = scene.clone().pinhole();
    let frame = trace_frame(&sharp, &settings, &|_| ControlFlow::Continue(())).unwrap();
    frame.color
}

#[test]
fn no_scene_has_noise_when_unlit() {
    let mut differ = 0;
    for listing in list_scenes(scenes()).unwrap() {
        let scene = load_scene(&listing.folder, Some("unlit")).unwrap();
        assert_eq!(scene.id.to_string(), format!("{}@unlit", listing.name));
        assert!(scene.sun.is_none());
        let color = render(&scene, 1);
        assert_eq!(color, render(&scene, 2), "{}", scene.id);
        let lit = render(&load_scene(&listing.folder, None).unwrap(), 1);
        differ += usize::from(lit != color);
    }
    assert!(differ > 15, "light changes {differ} scenes");
}

#[test]
fn an_unlit_scene_is_exported_with_colours_alone() {
    let folder = tempfile::tempdir().unwrap();
    let scene = load_scene(scenes().join("railing"), Some("unlit")).unwrap();
    export_gltf(&scene, &tests::scenes().into(), "test", folder.path()).unwrap();
    let text = fs::read_to_string(folder.path().join("scene.gltf")).unwrap();
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(!text.contains("KHR_lights_punctual"));
    for material in document["materials"].as_array().unwrap() {
        let base = &material["pbrMetallicRoughness"]["baseColorFactor"];
        let base: Vec<f64> = (base.as_array().unwrap().iter())
            .map(|it| it.as_f64().unwrap())
            .collect();
        assert_eq!(base[..3], [0.0; 3], "{material}");
        let emitted = material["emissiveFactor"].as_array().unwrap();
        assert!(
            emitted.iter().any(|part| part.as_f64() > Some(0.0)),
            "{material}"
        );
    }
}
