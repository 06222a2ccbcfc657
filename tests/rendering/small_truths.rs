//! Small truths of scenes with even pictures.

use frame::{Alignment, Truth};
use tests::unwatched;
use tracer::{RenderSettings, Scene, trace_truth};

pub fn render_truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    let settings = RenderSettings {
        width: 16,
        height: 9,
        samples_per_pixel,
        ..RenderSettings::default()
    };
    trace_truth(scene, &settings, Alignment::Centred, &unwatched).expect("settings are allowed")
}
