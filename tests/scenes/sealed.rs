//! Sealed variants of every scene: changed by a seed.

use std::ops::ControlFlow;

use frame::{ColorSampling, Frame};
use tests::scenes;
use tracer::{RenderSettings, Scene, Seal, list_scenes, load_scene, trace_frame};

/// Renders one sample at each pixel's centre.
fn render(scene: &Scene) -> Frame {
    let mut settings = RenderSettings {
        width: 64,
        height: 36,
        samples_per_pixel: 1,
        ..RenderSettings::default()
    };
    settings.options.color = ColorSampling::Point;
    trace_frame(scene, &settings, &|_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn every_scene_has_sealed_variants_that_move_otherwise() {
    for listing in list_scenes(scenes()).unwrap() {
        let load = |variant| load_scene(&listing.folder, variant).unwrap();
        let [plain, sealed, other] = [None, Some("seal7"), Some("seal8")].map(load);
        assert_eq!(sealed.id.to_string(), format!("{}@seal7", listing.name));
        assert_ne!(sealed.hash, plain.hash);
        assert_ne!(sealed.hash, other.hash);
        let [plain, sealed, other] = [plain, sealed, other].map(|scene| render(&scene));
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
        let [before, after] = [&scene, &seal.apply(scene.clone())].map(render);
        let mut same = 0;
        for y in 0..36 {
            for x in 0..64 {
                let [here, there] = [*before.depth.at(x, y), *after.depth.at(63 - x, y)];
                let [own, other] = [*before.velocity.at(x, y), *after.velocity.at(63 - x, y)];
                let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * a.abs().max(1.0);
                same += usize::from(
                    close(here, there) && close(own[0], -other[0]) && close(own[1], other[1]),
                );
            }
        }
        // At silhouettes a rounding decides what a pixel's centre sees.
        let share = same as f64 / f64::from(64 * 36);
        assert!(share > 0.97, "{}: {share} of the pixels", listing.name);
    }
}
