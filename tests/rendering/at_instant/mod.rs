//! State at the frame's instant of everything that a shutter sees.
//!
//! The camera sees one metre as one pixel at the panels' distance, with the origin at the image's centre.

mod frozen;
mod placement;

use frame::{Alignment, Truth};
use glam::DVec3;
use tests::shapes::*;
use tracer::Scene;

use crate::renders::{render_truth, settings_of_two};

const WIDTH: u32 = 32;
const HEIGHT: u32 = 12;
/// Distance of the panels: half the height in pixels is the focal length at a vertical field of view of 90 degrees.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
const SPEED: f64 = 12.0;
/// Exposure in frames.
const EXPOSURE: f64 = 0.75;
/// Tolerance for 1024 stratified samples of a step. They err by less than 0.003 in nearly every pixel (measured for
/// coverage: 0.0022 rms in the worst).
const STEP_ERROR: f64 = 0.012;

fn render(scene: &Scene, alignment: Alignment, samples_per_pixel: u32) -> Truth {
    let mut settings = settings_of_two([WIDTH, HEIGHT], samples_per_pixel);
    settings.exposure = Some(EXPOSURE);
    render_truth(scene, &settings, alignment)
}

/// Makes an unlit wall, `gap` metres behind an unlit panel with its middle passing `at` at `t = 0`. Both are higher than any blur.
fn panel_over_wall(gap: f64, at: f64, width: f32) -> Scene {
    let mut scene = empty_scene("panel");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE - gap));
    add(&mut scene, rectangle(200.0, 200.0), glowing(0.2), wall);
    let motion = drift(DVec3::new(at, 0.0, -DISTANCE), DVec3::X * SPEED);
    add(&mut scene, rectangle(width, 100.0), glowing(0.8), motion);
    scene
}

/// Calls `check` with each column's left border, in pixels from the picture's centre, and the index of its pixel in the middle row.
fn for_each_column(mut check: impl FnMut(f64, usize)) {
    for column in 0..WIDTH {
        let left = f64::from(column) - 0.5 * f64::from(WIDTH);
        check(left, ((HEIGHT / 2) * WIDTH + column) as usize);
    }
}

/// Integrates `value` over a column of unit width and the shutter, by midpoints.
fn mean_over(left: f64, alignment: Alignment, value: impl Fn(f64, f64) -> f64) -> f64 {
    const STEPS: u32 = 400;
    let shutter = alignment.shutter(EXPOSURE).unwrap();
    let middle = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
    let places =
        (0..STEPS).flat_map(|x| (0..STEPS).map(move |t| (left + middle(x), shutter.at(middle(t)))));
    places.map(|(x, t)| value(x, t)).sum::<f64>() / f64::from(STEPS * STEPS)
}
