//! Settings of frames and truths.

use std::ops::RangeInclusive;

use frame::{Alignment, FrameOptions};
use serde::{Deserialize, Serialize};
use tracer::{FrameSettings, Scene, TruthSettings};

/// Columns and rows that a picture may have.
pub const SIDES: RangeInclusive<u32> = 16..=16384;

/// Upper limit on the replicates of a truth.
pub const MOST_REPLICATES: u32 = 4096;

/// Replicates of a truth that have as many samples as a frame, whatever number the truth has.
const FRAME_REPLICATES: u32 = 4;

/// Settings of every scene's frame and truths; run.json holds them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Mean samples per pixel of a truth, over all its replicates.
    pub samples_per_pixel: u32,
    /// Independent, complete renders behind a truth; an even number.
    pub replicates: u32,
    /// Seed of all randomness.
    pub seed: u64,
    /// Choice of what the frame holds.
    #[serde(flatten)]
    pub options: FrameOptions,
    /// Pixels by which the frame reaches beyond the picture on every side.
    pub guard_band: u32,
    /// Exposure in frames; none takes the scene's. Not in run.json, where every case has its own.
    #[serde(skip)]
    pub exposure: Option<f64>,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            samples_per_pixel: 256,
            replicates: 8,
            seed: 1,
            options: FrameOptions::default(),
            guard_band: 0,
            exposure: None,
        }
    }
}

impl RenderSettings {
    /// Takes another number of replicates, each with as many samples as before.
    pub fn with_replicates(&self, replicates: u32) -> Self {
        let each = self.samples_per_pixel / self.replicates;
        Self {
            samples_per_pixel: each.saturating_mul(replicates),
            replicates,
            ..self.clone()
        }
    }

    /// Lists name and value of every setting that all cases of a run share.
    pub(crate) fn list(&self) -> [(&'static str, String); 8] {
        [
            ("picture size", format!("{}x{}", self.width, self.height)),
            (
                "number of samples per pixel",
                self.samples_per_pixel.to_string(),
            ),
            ("number of replicates", self.replicates.to_string()),
            ("seed", self.seed.to_string()),
            ("velocity", self.options.velocity.to_string()),
            ("color", self.options.color.to_string()),
            ("sky velocity", self.options.sky_velocity.to_string()),
            ("guard band", format!("{} px", self.guard_band)),
        ]
    }

    /// Mean samples per pixel of a frame: half as many as a truth of eight replicates has. The pilot shares them out, so that
    /// they leave about the noise that twice as many would leave without it.
    pub(crate) fn frame_samples(&self) -> u32 {
        FRAME_REPLICATES * self.samples_per_pixel / self.replicates
    }

    /// Selects what the tracer needs for a scene's frame.
    pub(crate) fn for_frame(&self, scene: &Scene) -> FrameSettings {
        FrameSettings {
            width: self.width,
            height: self.height,
            exposure: self.exposure.unwrap_or(scene.exposure),
            options: self.options,
            guard_band: self.guard_band,
            samples_per_pixel: self.frame_samples(),
            seed: self.seed,
        }
    }

    /// Selects what the tracer needs for one of a scene's truths.
    pub(crate) fn for_truth(&self, scene: &Scene, alignment: Alignment) -> TruthSettings {
        TruthSettings {
            width: self.width,
            height: self.height,
            exposure: self.exposure.unwrap_or(scene.exposure),
            alignment,
            samples_per_pixel: self.samples_per_pixel,
            replicates: self.replicates,
            seed: self.seed,
        }
    }
}
