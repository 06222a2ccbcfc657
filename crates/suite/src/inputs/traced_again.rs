//! Settings with which a frame is rendered again in another form.

use frame::Frame;
use tracer::RenderSettings;

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
