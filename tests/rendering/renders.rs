//! Renders of scenes, means of their colours, and their comparison with known numbers.

use frame::{Alignment, Frame, Ladder, Truth};
use glam::Vec3;
use tests::{scenes, unwatched};
use tracer::{RenderSettings, Scene, load_scene, trace_frame, trace_ladder, trace_truth};

/// Takes a size and samples per pixel, those of a truth in 8 replicates.
pub fn settings([width, height]: [u32; 2], samples_per_pixel: u32) -> RenderSettings {
    RenderSettings {
        width,
        height,
        samples_per_pixel,
        ..RenderSettings::default()
    }
}

/// Takes a size and samples per pixel in 2 replicates.
pub fn settings_of_two(size: [u32; 2], samples_per_pixel: u32) -> RenderSettings {
    RenderSettings {
        replicates: 2,
        ..settings(size, samples_per_pixel)
    }
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
    render_truth(
        scene,
        &settings([16, 9], samples_per_pixel),
        Alignment::Centred,
    )
}

/// Loads a shipped scene.
pub fn load_shipped(name: &str) -> Scene {
    load_scene(scenes().join(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the mean colour over the picture.
pub fn mean_color(truth: &Truth) -> Vec3 {
    let color = truth.mean().color;
    let sum: Vec3 = color.pixels.iter().map(|pixel| Vec3::from(*pixel)).sum();
    sum / color.pixels.len() as f32
}

/// Fails unless two numbers are as near as the tolerance.
#[track_caller]
pub fn expect_near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(off <= tolerance, "{what}: {found}, not {expected}");
}
