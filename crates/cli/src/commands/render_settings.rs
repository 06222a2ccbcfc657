//! Settings of renders from the command line, checked.

use store::MAX_REPLICATES;
use suite::Error;
use tracer::{MAX_SAMPLES, RenderSettings};

use crate::arguments::SceneArgs;

/// Makes the settings of a render, for pictures of one size.
pub fn make_render_settings(
    args: &SceneArgs,
    (width, height): (u32, u32),
    replicates: u32,
) -> Result<RenderSettings, Error> {
    if let Some(exposure) = args.exposure {
        check_exposure(exposure)?;
    }
    check_samples(args.samples_per_pixel)?;
    check_replicates(replicates)?;
    Ok(RenderSettings {
        width,
        height,
        exposure: args.exposure,
        options: args.frame_options(),
        guard_band: args.guard_band,
        samples_per_pixel: args.samples_per_pixel,
        seed: args.seed,
        ..RenderSettings::default()
    }
    .with_replicates(replicates))
}

fn check_samples(samples_per_pixel: u32) -> Result<(), Error> {
    let replicates = RenderSettings::default().replicates;
    // A frame has as many samples as all replicates of a truth.
    let most = MAX_SAMPLES / replicates;
    let each = samples_per_pixel / replicates;
    if each.is_power_of_two() && each <= most && each * replicates == samples_per_pixel {
        return Ok(());
    }
    let nearest = each.clamp(1, most).next_power_of_two() * replicates;
    refuse!(
        "--samples-per-pixel {samples_per_pixel}; allowed: {replicates} times a power of two, up to {MAX_SAMPLES}, such as {nearest}"
    )
}

/// Refuses numbers that make no two equal halves, or more replicates than a truth may have.
fn check_replicates(replicates: u32) -> Result<(), Error> {
    match (2..=MAX_REPLICATES).contains(&replicates) && replicates.is_multiple_of(2) {
        true => Ok(()),
        false => refuse!(
            "--replicates {replicates}: allowed are even numbers from 2 to {MAX_REPLICATES}, such as 8"
        ),
    }
}

/// Refuses exposures that no shutter has.
pub fn check_exposure(exposure: f64) -> Result<(), Error> {
    frame::Alignment::Trailing
        .shutter(exposure)
        .map(drop)
        .map_err(|error| Error::Usage(format!("--exposure: {error}")))
}
