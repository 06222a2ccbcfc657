//! What to render, and what is refused.

use frame::{Alignment, ColorSampling, Shutter, ShutterError, VelocityKind};

use crate::film::sampler::MOST_SAMPLES;
use crate::limits::{LARGEST_SIDE, MOST_PIXELS};
use crate::motion::velocity::looks_back_to;
use crate::scene::Scene;

/// Greatest distance from the origin of anything that is rendered, in metres: the areas of boxes must be 32-bit numbers, and
/// positions exact to less than a metre.
pub const LARGEST_REACH: f64 = 1e15;
/// Greatest value of a pixel, in any layer but depth: sums and products of pixels must be 32-bit numbers.
pub const LARGEST_VALUE: f32 = 1e36;

/// How to render the frame of the instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Exposure that a filter is to blur by, in frames; the frame itself does not depend on it.
    pub exposure: f64,
    /// What the velocity buffer holds.
    pub velocity: VelocityKind,
    /// How colour and coverage are sampled.
    pub color: ColorSampling,
    /// Whether the background has its velocity, or zero.
    pub sky_velocity: bool,
    /// Pixels by which all rasters reach beyond the picture on every side.
    pub guard_band: u32,
    /// Samples of colour and coverage per pixel, a power of two up to 65536; time grows with it.
    pub samples_per_pixel: u32,
    /// Chooses the random numbers.
    pub seed: u64,
}

/// How to render the truth of a shutter interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Length of the shutter interval in frames.
    pub exposure: f64,
    /// Where the interval lies relative to the instant.
    pub alignment: Alignment,
    /// Samples per pixel over all replicates; time grows with it, noise falls faster than its square root.
    pub samples_per_pixel: u32,
    /// Independent, complete renders, an even number; each gets a power of two of samples. More of them measure the
    /// noise better and stratify worse.
    pub replicates: u32,
    /// Chooses the random numbers.
    pub seed: u64,
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TraceError {
    /// The watcher asked to stop.
    #[error("rendering was cancelled")]
    Cancelled,
    /// No pixels, or too many.
    #[error(
        "size is {width}x{height}; allowed: 1 to {LARGEST_SIDE} pixels on either side, {MOST_PIXELS} in all"
    )]
    Size {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// An exposure that no shutter has.
    #[error(transparent)]
    Shutter(#[from] ShutterError),
    /// An odd number of replicates has no two halves; one has no spread.
    #[error("replicates is {0}; allowed: even numbers from 2, such as 8")]
    Replicates(u32),
    /// Samples that do not divide into powers of two.
    #[error(
        "samples per pixel is {samples_per_pixel} over {replicates} replicates; allowed: {replicates} times a \
         power of two up to {MOST_SAMPLES}, such as {nearest}"
    )]
    Samples {
        /// What was asked for.
        samples_per_pixel: u32,
        /// Among how many replicates it was to be divided.
        replicates: u32,
        /// The nearest allowed number.
        nearest: u32,
    },
    /// Sub-frames of a ladder that cannot be.
    #[error("sub-frames are {0:?}; allowed: rising whole numbers from 1, such as 1, 2, 4")]
    Subframes(Vec<u32>),
    /// An object too far away, or too large, to be traced.
    #[error(
        "scene {scene}: object {object} reaches {reach:e} m from the origin at some time that is rendered; allowed: {LARGEST_REACH:e} \
         m; check its vertices, scale and keys, and those of its parents"
    )]
    Reach {
        /// The scene's name.
        scene: String,
        /// The object's name.
        object: String,
        /// Metres; infinite or NaN where no number tells.
        reach: f64,
    },
    /// A pixel that is no finite number, or is too large.
    #[error(
        "scene {scene}: {layer} is {value:e} at ({x}, {y}); allowed: finite numbers up to {LARGEST_VALUE:e}; lower the emission, \
         the background or the sun that is seen there, or widen the sun"
    )]
    NotFinite {
        /// The scene's name.
        scene: String,
        /// What the rendered layer is called in its file.
        layer: String,
        /// The value found.
        value: f32,
        /// Column, from 0 on the left.
        x: u32,
        /// Row, from 0 at the top.
        y: u32,
    },
    /// A camera whose field of view leaves the possible while the shutter is open.
    #[error(
        "scene {scene}: the camera's vertical field of view is {degrees:.3} degrees at time {time} frames; allowed: \
         above 0 and below 180 at every time that is rendered; its keys go on beyond the first and last"
    )]
    FieldOfView {
        /// The scene's name.
        scene: String,
        /// The field of view, in degrees.
        degrees: f64,
        /// When, in frames.
        time: f64,
    },
}

impl Default for FrameSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            exposure: 0.5,
            velocity: VelocityKind::default(),
            color: ColorSampling::default(),
            sky_velocity: true,
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
    /// Refuses what cannot be rendered.
    pub fn check(&self, scene: &Scene) -> Result<(), TraceError> {
        check_size(self.width, self.height)?;
        check_size(
            self.width.saturating_add(self.guard_band.saturating_mul(2)),
            self.height
                .saturating_add(self.guard_band.saturating_mul(2)),
        )?;
        Alignment::Trailing.shutter(self.exposure)?;
        check_samples(self.samples_per_pixel, 1)?;
        check_field_of_view(scene, looks_back_to(self.velocity), 0.0)
    }
}

impl TruthSettings {
    /// Samples per pixel of each replicate.
    pub fn samples_per_replicate(&self) -> u32 {
        self.samples_per_pixel / self.replicates
    }

    /// Refuses what cannot be rendered; else the shutter.
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
