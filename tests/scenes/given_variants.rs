//! Variants that every scene has: sealed ones, changed by a seed, and `unlit`, whose surfaces send out their own colours.

use std::fs;

use engine::export_gltf;
use frame::{ColorSampling, Frame};
use tests::{scenes, unwatched};
use tracer::{RenderSettings, Scene, Seal, list_scenes, load_scene, trace_frame};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 36;

/// Renders at the pixels' centres, without a lens, which has noise of its own.
fn render(scene: &Scene, seed: u64) -> Frame {
    let mut settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 1,
        seed,
        ..RenderSettings::default()
    };
    settings.options.color = ColorSampling::Point;
    trace_frame(&scene.clone().pinhole(), &settings, &unwatched).unwrap()
}

#[test]
fn every_scene_has_sealed_variants_that_move_otherwise() {
    for listing in list_scenes(scenes()).unwrap() {
        let load = |variant| load_scene(&listing.folder, variant).unwrap();
        let [plain, sealed, other] = [None, Some("seal7"), Some("seal8")].map(load);
        assert_eq!(sealed.id.to_string(), format!("{}@seal7", listing.name));
        assert_ne!(sealed.hash, plain.hash);
        assert_ne!(sealed.hash, other.hash);
        let [plain, sealed, other] = [plain, sealed, other].map(|scene| render(&scene, 1));
        assert_ne!(sealed.velocity, plain.velocity, "{}", listing.name);
        assert_ne!(sealed.velocity, other.velocity, "{}", listing.name);
        let moves = |frame: &Frame| frame.velocity.pixels.iter().any(|own| *own != [0.0; 2]);
        assert!(moves(&sealed), "{} stands still", listing.name);
    }
}

#[test]
fn a_mirrored_scene_is_seen_left_for_right() {
    for listing in list_scenes(scenes()).unwrap() {
        let scene = load_scene(&listing.folder, None).unwrap();
        let seal = Seal {
            mirrored: true,
            ..Seal::NOTHING
        };
        let [before, after] = [&scene, &seal.apply(scene.clone())].map(|scene| render(scene, 1));
        let mut same = 0;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let [here, there] = [*before.depth.at(x, y), *after.depth.at(WIDTH - 1 - x, y)];
                let [own, other] = [
                    *before.velocity.at(x, y),
                    *after.velocity.at(WIDTH - 1 - x, y),
                ];
                let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * a.abs().max(1.0);
                same += usize::from(
                    close(here, there) && close(own[0], -other[0]) && close(own[1], other[1]),
                );
            }
        }
        // At silhouettes a rounding decides what a pixel's centre sees.
        let share = same as f64 / f64::from(WIDTH * HEIGHT);
        assert!(share > 0.97, "{}: {share} of the pixels", listing.name);
    }
}

#[test]
fn no_scene_has_noise_when_unlit() {
    let mut differ = 0;
    for listing in list_scenes(scenes()).unwrap() {
        let scene = load_scene(&listing.folder, Some("unlit")).unwrap();
        assert_eq!(scene.id.to_string(), format!("{}@unlit", listing.name));
        assert!(scene.sun.is_none());
        let color = render(&scene, 1).color;
        assert_eq!(color, render(&scene, 2).color, "{}", scene.id);
        let lit = render(&load_scene(&listing.folder, None).unwrap(), 1).color;
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
        let shines = emitted.iter().any(|part| part.as_f64() > Some(0.0));
        assert!(shines, "{material}");
    }
}
