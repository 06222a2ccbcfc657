//! Small truths of scenes with even pictures.

use frame::{Alignment, Truth};
use tests::unwatched;
use tracer::{Scene, TruthSettings, trace_truth};

pub fn render_truth(scene: &Scene, samples_per_pixel: u32) -> Truth {
    let settings = TruthSettings {
        width: 16,
        height: 9,
        exposure: 1.0,
        alignment: Alignment::Centred,
        samples_per_pixel,
        ..TruthSettings::default()
    };
    trace_truth(scene, &settings, &unwatched).expect("settings are allowed")
}
