//! Allowed render settings, their list, and the settings that a frame was rendered with.

use std::ops::RangeInclusive;

use frame::{Frame, Size};
use tracer::RenderSettings;

/// Allowed numbers of columns and rows of a picture.
pub const SIDES: RangeInclusive<u32> = 16..=16384;

/// Lists name and value of every setting that a run's cases share.
pub fn list_settings(settings: &RenderSettings) -> [(&'static str, String); 8] {
    [
        (
            "picture size",
            format!("{}x{}", settings.width, settings.height),
        ),
        (
            "number of samples per pixel",
            settings.samples_per_pixel.to_string(),
        ),
        ("number of replicates", settings.replicates.to_string()),
        ("seed", settings.seed.to_string()),
        ("velocity", settings.options.velocity.to_string()),
        ("color", settings.options.color.to_string()),
        ("sky velocity", settings.options.sky_velocity.to_string()),
        ("guard band", format!("{} px", settings.guard_band)),
    ]
}

/// Reads the settings of a frame that was rendered here.
pub(crate) fn settings_of(frame: &Frame) -> RenderSettings {
    let Size { width, height } = frame.size();
    let band = frame.guard_band;
    RenderSettings {
        width: width - 2 * band,
        height: height - 2 * band,
        guard_band: band,
        options: frame.options,
        samples_per_pixel: frame.provenance.samples_per_pixel,
        replicates: frame.provenance.replicates,
        seed: frame.provenance.seed,
        exposure: Some(frame.exposure),
    }
}
