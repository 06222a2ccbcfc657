//! The pass of depth of field on pictures of a pinhole, against the traced, defocused instant.

use frame::Image;
use glam::DVec3;
use scene::Scene;
use tracer::{Defocus, RenderSettings, TraceError, trace_defocus};

use super::with_lens;
use crate::renders::*;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 27;
/// Distance at which a metre is a pixel, at a vertical field of view of 90 degrees.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;

fn own_settings() -> RenderSettings {
    settings([WIDTH, HEIGHT], 256)
}

fn trace_pass(scene: &Scene) -> Defocus {
    trace_defocus(scene, &own_settings(), &unwatched).unwrap()
}

/// Renders the frame of a scene, the pass's output for the pinhole's frame, and the pinhole's
/// frame.
fn render(scene: &Scene) -> [Image; 3] {
    let pinhole = render_frame(&scene.clone().pinhole(), &own_settings()).color;
    let pass = trace_pass(scene).apply_to_color(&pinhole);
    [render_frame(scene, &own_settings()).color, pass, pinhole]
}

/// Makes an unlit wall with discs on it, at one distance.
fn spotted_wall() -> Scene {
    let mut scene = empty_scene("spots");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE));
    add(&mut scene, rectangle(400.0, 400.0), glowing(0.2), wall);
    for (x, y) in [(-9.0, 3.0), (2.0, -4.0), (11.0, 6.0)] {
        let spot = placed(DVec3::new(x, y, -DISTANCE + 1e-3));
        add(&mut scene, disc(3.0, 64), glowing(1.0), spot);
    }
    scene
}

#[test]
fn where_the_pinhole_shows_everything_the_pass_is_the_lens() {
    let scene = with_lens(spotted_wall(), 5.0, 0.5 * DISTANCE);
    let [lens, pass, pinhole] = render(&scene);
    let [with, without] = [&pass, &pinhole].map(|picture| rms_difference(picture, &lens));
    // 256 rays of a circle of 20 pixels, and the pixels' own width once more: measured 0.008,
    // against 0.16.
    assert!(with < 0.02 && without > 5.0 * with, "{with} {without}");
    // The pass keeps light, except what leaves the picture on one side and comes back on the other.
    expect_near("light", mean_of(&pass) / mean_of(&lens), 1.0, 0.02);
    let cancelled = trace_defocus(&scene, &own_settings(), &|_| {
        std::ops::ControlFlow::Break(())
    });
    assert_eq!(cancelled.err(), Some(TraceError::Cancelled));
    // Every pass gives the same picture.
    assert_eq!(trace_pass(&scene).apply_to_color(&pinhole), pass);
}

#[test]
fn what_is_in_focus_and_what_has_no_lens_stays_as_it_is() {
    let [lens, pass, pinhole] = render(&with_lens(spotted_wall(), 5.0, DISTANCE));
    assert!(rms_difference(&lens, &pinhole) < 1e-3);
    // The discs are a millimetre in front of the focus: a ray in some thousands reads the next
    // pixel.
    assert!(rms_difference(&pass, &pinhole) < 1e-3);
    let [_, pass, pinhole] = render(&spotted_wall());
    assert_eq!(pass, pinhole);
}

/// Makes a near ball, out of focus, in front of the wall, in focus.
fn ball_before_wall() -> Scene {
    let mut scene = spotted_wall();
    let place = placed(DVec3::new(0.5, 0.0, -4.0));
    add(&mut scene, icosphere(1.5, 3), glowing(0.6), place);
    with_lens(scene, 3.0, DISTANCE)
}

#[test]
fn what_the_pinhole_hides_behind_an_edge_is_traced() {
    let [lens, pass, pinhole] = render(&ball_before_wall());
    let [with, without] = [&pass, &pinhole].map(|picture| rms_difference(picture, &lens));
    // A pass without the wall behind the ball makes the ball's rim too dense: 0.7 of the pinhole's
    // difference.
    assert!(with < 0.3 * without, "{with} {without}");
}

#[test]
fn colour_comes_from_the_picture_and_coverage_sums_to_one() {
    let scene = ball_before_wall();
    let frame = render_frame(&scene.clone().pinhole(), &own_settings());
    let pass = trace_pass(&scene);
    let picture = pass.apply(&frame.picture());
    assert_eq!(picture.coverage.len(), scene.objects.len() + 1);
    for pixel in 0..picture.color.pixels.len() {
        let parts = picture.coverage.iter().map(|plane| plane.pixels[pixel]);
        let sum: f32 = parts.sum();
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    }
    // Far from the ball no sample is left out: a picture twice as bright comes out twice as bright.
    let bright = frame.color.map(|color| color.map(|value| 2.0 * value));
    let bright = pass.apply_to_color(&bright).at(1, 1)[0];
    let plain = picture.color.at(1, 1)[0];
    assert!((bright - 2.0 * plain).abs() < 1e-5, "{bright} {plain}");
}
