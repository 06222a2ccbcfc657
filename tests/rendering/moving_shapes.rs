//! Renders of moving shapes, and checks of their coverage.
//!
//! The camera sees one metre as one pixel at the shapes' distance, with the origin at the image's centre.

use frame::{Alignment, Truth};
use glam::DVec2;
use tests::statistics::{coverage_estimates, expect_agreement, expect_total};
use tests::unwatched;
use tracer::{RenderSettings, Scene, trace_truth};

pub const WIDTH: u32 = 32;
pub const HEIGHT: u32 = 18;
/// Distance of the shapes: half the height in pixels is the focal length at a vertical field of view of 90 degrees.
pub const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
pub const SPEED: f64 = 14.0;
/// Exposure in frames.
pub const EXPOSURE: f64 = 0.75;

pub fn truth_settings() -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        exposure: Some(EXPOSURE),
        samples_per_pixel: 1024,
        ..RenderSettings::default()
    }
}

pub fn render_truth(scene: &Scene, alignment: Alignment) -> Truth {
    trace_truth(scene, &truth_settings(), alignment, &unwatched).expect("settings are allowed")
}

/// Returns the lower left corner of a pixel, y up.
pub fn pixel_corner(x: u32, y: u32) -> DVec2 {
    DVec2::new(
        f64::from(x) - 0.5 * f64::from(WIDTH),
        0.5 * f64::from(HEIGHT) - f64::from(y) - 1.0,
    )
}

/// Compares the coverage of every pixel with the exact one.
pub fn expect_coverage(what: &str, truth: &Truth, exact: impl Fn(u32, u32) -> f64) {
    let estimates = coverage_estimates(truth, exact);
    expect_agreement(what, &estimates, truth.provenance.replicates);
    // Shifts and stretches show in the first moments.
    expect_total(what, &estimates, |pixel| {
        f64::from(pixel as u32 % WIDTH) - 15.5
    });
    expect_total(what, &estimates, |pixel| {
        f64::from(pixel as u32 / WIDTH) - 8.5
    });
}
