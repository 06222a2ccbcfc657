//! White shapes in motion on black, and checks of their coverage.
//!
//! The camera sees one metre as one pixel at the shapes' distance, with the origin at the image's
//! centre.

use frame::{Alignment, Shutter, Truth};
use glam::{DQuat, DVec2};
use scene::{Key, Mesh, Scene};
use tests::statistics::{coverage_estimates, expect_agreement, expect_total};
use tracer::RenderSettings;

use crate::renders::*;

pub const WIDTH: u32 = 32;
pub const HEIGHT: u32 = 18;
/// Distance of the shapes: half the height in pixels is the focal length at a vertical field of
/// view of 90 degrees.
pub const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
pub const SPEED: f64 = 14.0;

pub fn truth_settings() -> RenderSettings {
    settings([WIDTH, HEIGHT], 1024)
}

/// Makes a scene of one mesh, turned by `angle`, at `place(t)` at these times, straight between
/// them. The shutter is open for 0.75 frames.
pub fn moving_scene(mesh: Mesh, angle: f64, times: &[f64], place: impl Fn(f64) -> DVec2) -> Scene {
    let mut scene = empty_scene("moving");
    scene.exposure = 0.75;
    let key = |&time: &f64| Key {
        time,
        translation: place(time).extend(-DISTANCE),
        orientation: DQuat::from_rotation_z(angle),
        ..Key::REST
    };
    let keys: Vec<Key> = times.iter().map(key).collect();
    add(&mut scene, mesh, glowing(1.0), through(keys));
    scene
}

/// Makes a half-plane with its edge `along(t)` pixels from the centre in the direction of `normal`.
pub fn half_plane_scene(normal: DVec2, times: &[f64], along: impl Fn(f64) -> f64) -> Scene {
    let place = |time: f64| (along(time) - 200.0) * normal;
    moving_scene(rectangle(400.0, 400.0), normal.to_angle(), times, place)
}

/// Returns the lower left corner of a pixel, y up.
pub fn pixel_corner(x: u32, y: u32) -> DVec2 {
    DVec2::new(
        f64::from(x) - 0.5 * f64::from(WIDTH),
        0.5 * f64::from(HEIGHT) - f64::from(y) - 1.0,
    )
}

/// Integrates over a pixel, by the midpoint rule on `side` squared points.
pub fn mean_over_pixel(corner: DVec2, side: u32, value: impl Fn(DVec2) -> f64) -> f64 {
    let at = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
    let points = (0..side * side).map(|index| DVec2::new(at(index % side), at(index / side)));
    points.map(|point| value(corner + point)).sum::<f64>() / f64::from(side * side)
}

/// Renders a truth, and compares the only object's coverage with the exact one, which depends on a
/// pixel's lower left corner and the shutter; then colour and motion with coverage.
pub fn expect_coverage(
    what: &str,
    scene: &Scene,
    alignment: Alignment,
    exact: impl Fn(DVec2, Shutter) -> f64,
) -> Truth {
    let what = format!("{what}, {alignment}");
    let truth = render_truth(scene, &truth_settings(), alignment);
    let estimates = coverage_estimates(&truth, |x, y| exact(pixel_corner(x, y), truth.shutter));
    expect_agreement(&what, &estimates, truth.provenance.replicates);
    // The first moments show shifts and stretches.
    let column = |pixel: usize| f64::from(pixel as u32 % WIDTH) - 15.5;
    expect_total(&what, &estimates, column);
    let row = |pixel: usize| f64::from(pixel as u32 / WIDTH) - 8.5;
    expect_total(&what, &estimates, row);
    // The object emits 1 on black.
    let mean = truth.mean();
    for (pixel, color) in mean.color.pixels.iter().enumerate() {
        assert!((mean.coverage[1].pixels[pixel] - color[0]).abs() < 1e-6);
        assert!((mean.coverage[0].pixels[pixel] + color[0] - 1.0).abs() < 1e-6);
    }
    assert_eq!(truth.motion, mean.coverage[1], "only the object moves");
    truth
}
