//! Variants of every scene: sealed ones, changed by a seed, and `unlit`, with surfaces that emit
//! their own colours.

use frame::{ColorSampling, Frame};
use scene::{Scene, Seal};
use tests::{settings, unwatched};
use tracer::trace_frame;

use crate::{load_shipped, shipped};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 36;

/// Renders at the pixels' centres, and without a lens, since lenses make noise.
fn render(scene: &Scene, seed: u64) -> Frame {
    let mut settings = settings([WIDTH, HEIGHT], 1);
    settings.seed = seed;
    settings.options.color = ColorSampling::Point;
    trace_frame(&scene.clone().pinhole(), &settings, &unwatched).unwrap()
}

#[test]
fn every_scene_has_sealed_variants_that_move_otherwise() {
    for name in shipped() {
        let load = |variant| load_shipped(&format!("{name}{variant}"));
        let [plain, sealed, other] = ["", "@seal7", "@seal8"].map(load);
        assert_eq!(sealed.id.to_string(), format!("{name}@seal7"));
        assert_ne!(sealed.hash, plain.hash);
        assert_ne!(sealed.hash, other.hash);
        let [plain, sealed, other] = [plain, sealed, other].map(|scene| render(&scene, 1));
        assert_ne!(sealed.velocity, plain.velocity, "{name}");
        assert_ne!(sealed.velocity, other.velocity, "{name}");
        let moves = |frame: &Frame| {
            frame
                .velocity
                .pixels
                .iter()
                .any(|velocity| *velocity != [0.0; 2])
        };
        assert!(moves(&sealed), "{name} stands still");
    }
}

#[test]
fn a_mirrored_scene_is_seen_left_for_right() {
    for name in shipped() {
        let scene = load_shipped(&name);
        let mut seal = Seal::NOTHING;
        seal.mirrored = true;
        let [before, after] = [&scene, &seal.apply(scene.clone())].map(|scene| render(scene, 1));
        let mut same = 0;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let [here, there] = [*before.depth.at(x, y), *after.depth.at(WIDTH - 1 - x, y)];
                let [right, down] = *before.velocity.at(x, y);
                let [left, below] = *after.velocity.at(WIDTH - 1 - x, y);
                let close = |(a, b): (f32, f32)| (a - b).abs() <= 1e-3 * a.abs().max(1.0);
                let pairs = [(here, there), (right, -left), (down, below)];
                same += usize::from(pairs.into_iter().all(close));
            }
        }
        // At silhouettes, rounding decides what a pixel's centre sees.
        let share = same as f64 / f64::from(WIDTH * HEIGHT);
        assert!(share > 0.97, "{name}: {share} of the pixels");
    }
}

#[test]
fn no_scene_has_noise_when_unlit() {
    let mut differ = 0;
    for name in shipped() {
        let scene = load_shipped(&format!("{name}@unlit"));
        assert_eq!(scene.id.to_string(), format!("{name}@unlit"));
        assert!(scene.sun.is_none());
        let color = render(&scene, 1).color;
        assert_eq!(color, render(&scene, 2).color, "{}", scene.id);
        let lit = render(&load_shipped(&name), 1).color;
        differ += usize::from(lit != color);
    }
    assert!(differ > 15, "light changes {differ} scenes");
}
