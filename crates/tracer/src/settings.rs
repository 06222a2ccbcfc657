//! The settings of frames and truths, and the check of each.

use frame::{Alignment, FrameOptions, Shutter};

use crate::error::TraceError;
use crate::film::sampler::MOST_SAMPLES;
use crate::limits::{LARGEST_SIDE, MOST_PIXELS};
use crate::motion::velocity::earliest_time;
use crate::scene::Scene;

/// Settings of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Exposure that filters blur by, in frames; no pixel of the frame depends on it.
    pub exposure: f64,
    /// Choice of what the frame holds.
    pub options: FrameOptions,
    /// Pixels by which all rasters extend beyond the picture on every side.
    pub guard_band: u32,
    /// Mean samples of colour and coverage per pixel, a power of two up to 65536; time grows with it. A pilot shares them out.
    pub samples_per_pixel: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Settings of a truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Length of the shutter interval in frames.
    pub exposure: f64,
    /// Position of the interval relative to the instant.
    pub alignment: Alignment,
    /// Mean samples per pixel over all replicates; time grows with it, noise falls faster than its square root. A pilot shares
    /// them out.
    pub samples_per_pixel: u32,
    /// Independent, complete renders, an even number; each gets a power of two of samples. More of them measure the noise
    /// better and stratify worse.
    pub replicates: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for FrameSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            exposure: 0.5,
            options: FrameOptions::default(),
            guard_band: 0,
            samples_per_pixel: 256,
            seed: 0,
        }
    }
}

impl Default for TruthSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            exposure: 0.5,
            alignment: Alignment::Trailing,
            samples_per_pixel: 256,
            replicates: 8,
            seed: 0,
        }
    }
}

impl FrameSettings {
    /// Refuses settings with which the scene cannot be rendered.
    pub fn check(&self, scene: &Scene) -> Result<(), TraceError> {
        check_size(self.width, self.height)?;
        check_size(
            self.width.saturating_add(self.guard_band.saturating_mul(2)),
            self.height
                .saturating_add(self.guard_band.saturating_mul(2)),
        )?;
        Alignment::Trailing.shutter(self.exposure)?;
        check_samples(self.samples_per_pixel, 1)?;
        check_field_of_view(scene, earliest_time(self.options.velocity), 0.0)
    }
}

impl TruthSettings {
    /// Samples per pixel of each replicate.
    pub fn samples_per_replicate(&self) -> u32 {
        self.samples_per_pixel / self.replicates
    }

    /// Refuses settings with which the scene cannot be rendered; returns the shutter.
    pub fn check(&self, scene: &Scene) -> Result<Shutter, TraceError> {
        check_size(self.width, self.height)?;
        if self.replicates < 2 || !self.replicates.is_multiple_of(2) {
            return Err(TraceError::Replicates(self.replicates));
        }
        check_samples(self.samples_per_pixel, self.replicates)?;
        let shutter = self.alignment.shutter(self.exposure)?;
        scene.shutter_profile.check()?;
        let whole = scene.shutter_profile.whole(shutter);
        check_field_of_view(scene, whole.open, whole.close)?;
        Ok(shutter)
    }
}

fn check_size(width: u32, height: u32) -> Result<(), TraceError> {
    let allowed = 1..=LARGEST_SIDE;
    let pixels = u64::from(width) * u64::from(height);
    if allowed.contains(&width) && allowed.contains(&height) && pixels <= MOST_PIXELS {
        Ok(())
    } else {
        Err(TraceError::Size { width, height })
    }
}

fn check_samples(samples_per_pixel: u32, replicates: u32) -> Result<(), TraceError> {
    let each = samples_per_pixel / replicates;
    if each * replicates == samples_per_pixel && each.is_power_of_two() && each <= MOST_SAMPLES {
        return Ok(());
    }
    Err(TraceError::Samples {
        samples_per_pixel,
        replicates,
        nearest: each
            .clamp(1, MOST_SAMPLES)
            .next_power_of_two()
            .saturating_mul(replicates),
    })
}

fn check_field_of_view(scene: &Scene, from: f64, to: f64) -> Result<(), TraceError> {
    for time in scene.camera.vertical_fov_extremes(from, to) {
        let fov = scene.camera.vertical_fov_at(time);
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(TraceError::FieldOfView {
                scene: scene.name.clone(),
                degrees: fov.to_degrees(),
                time,
            });
        }
    }
    Ok(())
}
