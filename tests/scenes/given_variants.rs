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

/// Scenes of each kind: things that turn, bend, ride with the camera, let light pass, and are out
/// of focus.
const UNLIKE: [&str; 5] = ["fan", "flag", "cockpit", "sparks", "shallow_focus"];

/// Expects that a seal changes the motion of a scene, and each seal otherwise.
fn assert_sealed(name: &str) {
    let load = |variant| load_shipped(&format!("{name}{variant}"));
    let [plain, sealed, other] = ["", "@seal7", "@seal8"].map(load);
    assert_eq!(sealed.id.to_string(), format!("{name}@seal7"));
    assert_ne!(sealed.hash, plain.hash);
    assert_ne!(sealed.hash, other.hash);
    let [plain, sealed, other] = [plain, sealed, other].map(|scene| render(&scene, 1));
    assert_ne!(sealed.velocity, plain.velocity, "{name}");
    assert_ne!(sealed.velocity, other.velocity, "{name}");
    let mut velocities = sealed.velocity.pixels.iter();
    let moves = velocities.any(|velocity| *velocity != [0.0; 2]);
    assert!(moves, "{name} stands still");
}

#[test]
fn sealed_variants_move_otherwise() {
    UNLIKE.into_iter().for_each(assert_sealed);
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn every_scene_has_sealed_variants_that_move_otherwise() {
    shipped().iter().for_each(|name| assert_sealed(name));
}

/// Expects that a mirrored scene is seen left for right.
fn assert_mirrored(name: &str) {
    let scene = load_shipped(name);
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

#[test]
fn a_mirrored_scene_is_seen_left_for_right() {
    UNLIKE.into_iter().for_each(assert_mirrored);
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn every_mirrored_scene_is_seen_left_for_right() {
    shipped().iter().for_each(|name| assert_mirrored(name));
}

/// Expects that a scene has no noise when unlit; returns whether light changes it.
fn assert_no_noise_when_unlit(name: &str) -> bool {
    let scene = load_shipped(&format!("{name}@unlit"));
    assert_eq!(scene.id.to_string(), format!("{name}@unlit"));
    assert!(scene.sun.is_none());
    let color = render(&scene, 1).color;
    assert_eq!(color, render(&scene, 2).color, "{}", scene.id);
    render(&load_shipped(name), 1).color != color
}

#[test]
fn scenes_have_no_noise_when_unlit() {
    for name in UNLIKE {
        // Everything in two of them emits its light.
        let is_lit = !["sparks", "shallow_focus"].contains(&name);
        assert_eq!(assert_no_noise_when_unlit(name), is_lit, "{name}");
    }
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn no_scene_has_noise_when_unlit() {
    let all = shipped();
    let changed = all.iter().filter(|name| assert_no_noise_when_unlit(name));
    let count = changed.count();
    assert!(count > 15, "light changes {count} scenes");
}
