//! Allowed render settings, their list, and the settings of a truth's frame.

use std::ops::RangeInclusive;

use frame::Frame;
use tracer::RenderSettings;

/// Allowed numbers of columns and rows of a picture.
pub const SIDES: RangeInclusive<u32> = 16..=16384;

/// Replicates of a truth with as many samples as a frame, for truths of any size.
const FRAME_REPLICATES: u32 = 4;

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

/// Selects the settings of the frame that goes with truths: half as many samples as a truth of eight replicates. The pilot distributes
/// them, so that their noise is about that of twice as many without it.
pub(crate) fn frame_settings(settings: &RenderSettings) -> RenderSettings {
    RenderSettings {
        samples_per_pixel: FRAME_REPLICATES * settings.samples_per_pixel / settings.replicates,
        ..*settings
    }
}

/// Reads the settings of a frame that was rendered here.
pub(crate) fn settings_of(frame: &Frame) -> RenderSettings {
    let (width, height) = frame.size();
    let band = frame.guard_band;
    RenderSettings {
        width: width - 2 * band,
        height: height - 2 * band,
        guard_band: band,
        options: frame.options,
        samples_per_pixel: frame.provenance.samples_per_pixel,
        seed: frame.provenance.seed,
        exposure: Some(frame.exposure),
        ..RenderSettings::default()
    }
}
