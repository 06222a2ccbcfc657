//! Renders of scenes, means of their colours, and their comparison with known numbers.

use frame::{Alignment, Frame, Image, Ladder, Truth, VelocityKind};
pub use tests::settings;
use tests::{scenes, settings_of, unwatched};
use tracer::{RenderSettings, Scene, load_scene, trace_frame, trace_ladder, trace_truth};

/// Makes settings of a size, samples per pixel, and a kind of motion for the velocity buffer.
pub fn settings_with(
    size: [u32; 2],
    samples_per_pixel: u32,
    velocity: VelocityKind,
) -> RenderSettings {
    let mut settings = settings(size, samples_per_pixel);
    settings.options.velocity = velocity;
    settings
}

/// Makes settings of a size and samples per pixel in 2 replicates.
pub fn settings_of_two(size: [u32; 2], samples_per_pixel: u32) -> RenderSettings {
    settings_of(size, samples_per_pixel, 2)
}

pub fn render_frame(scene: &Scene, settings: &RenderSettings) -> Frame {
    trace_frame(scene, settings, &unwatched).expect("settings are allowed")
}

pub fn render_truth(scene: &Scene, settings: &RenderSettings, alignment: Alignment) -> Truth {
    trace_truth(scene, settings, alignment, &unwatched).expect("settings are allowed")
}

pub fn render_ladder(
    scene: &Scene,
    settings: &RenderSettings,
    truth: &Truth,
    subframes: &[u32],
) -> Ladder {
    trace_ladder(scene, settings, truth, subframes, &unwatched).expect("settings are allowed")
}

/// Renders a centred truth of 16 x 9 pixels.
pub fn render_small_truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    let settings = settings([16, 9], samples_per_pixel);
    render_truth(scene, &settings, Alignment::Centred)
}

/// Returns the mean of the first component over such a truth.
pub fn mean_radiance(scene: &Scene, samples_per_pixel: u32) -> f64 {
    mean_of(&render_small_truth(scene, samples_per_pixel).mean().color)
}

/// Loads a shipped scene.
pub fn load_shipped(name: &str) -> Scene {
    load_scene(scenes().join(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the mean of the first component over a picture.
pub fn mean_of(color: &Image) -> f64 {
    let values = color.pixels.iter().map(|pixel| f64::from(pixel[0]));
    values.sum::<f64>() / color.pixels.len() as f64
}

/// Returns the root of the mean squared difference of two pictures, in the first component.
pub fn rms_difference(a: &Image, b: &Image) -> f64 {
    let squares = (a.pixels.iter().zip(&b.pixels)).map(|(a, b)| f64::from(a[0] - b[0]).powi(2));
    (squares.sum::<f64>() / a.pixels.len() as f64).sqrt()
}

/// Fails unless two numbers are as near as the tolerance.
#[track_caller]
pub fn expect_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(off <= tolerance, "{what}: {found}, not {expected}");
}
