//! Noise of a filter, separated from its constant error.

use frame::{Image, Region};
use serde::{Deserialize, Serialize};

use crate::Reference;
use crate::color::cross_error::squared_error;
use crate::math::pooling::mean_over;
use crate::math::raster::{index_pixels, map_pixels};

/// Squared error of one frame where anything moves, in two parts that add up to it on average.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Jitter {
    /// Number of frames; only the filter's noise differs between them.
    pub frames: u32,
    /// Squared error of the mean over all noise, in display-scaled radiance: averaging over frames
    /// does not remove it. It is unbiased, so the truth's own noise may make it negative.
    pub bias: f64,
    /// Variance between frames, in display-scaled radiance: averaging over frames removes it.
    pub variance: f64,
}

impl Jitter {
    /// Returns the part of one frame's squared error that is noise, in [0, 1].
    pub fn noise_share(&self) -> f64 {
        self.variance / (self.bias.max(0.0) + self.variance).max(f64::MIN_POSITIVE)
    }
}

impl Reference<'_> {
    /// Measures the noise in the outputs of one filter for several frames; `None` if nothing moves.
    /// Panics on fewer than two outputs.
    pub fn jitter(&self, outputs: &[Image]) -> Option<Jitter> {
        assert!(
            outputs.len() >= 2,
            "a variance is between at least two frames"
        );
        let count = outputs.len() as f64;
        let scale = self.viewing().scale();
        let first = &outputs[0];
        let channels =
            |at: usize, c: usize| outputs.iter().map(move |o| f64::from(o.pixels[at][c]));
        let expectations = index_pixels(first, |at| -> [f64; 3] {
            std::array::from_fn(|c| channels(at, c).sum::<f64>() / count)
        });
        let variances = index_pixels(first, |at| {
            let means = expectations.pixels[at];
            let variance = |c: usize| {
                channels(at, c).map(|x| (x - means[c]).powi(2)).sum::<f64>() / (count - 1.0)
            };
            (0..3).map(variance).sum::<f64>() / 3.0 * scale * scale
        });
        let mean_image: Image = map_pixels(&expectations, |mean| mean.map(|mean| mean as f32));
        let halves = self.halves_for(&mean_image);
        let errors = squared_error(&mean_image, halves.each_ref(), scale);
        let pool = |map| mean_over(map, &self.regions, Region::Moving);
        let variance = pool(&variances)?;
        Some(Jitter {
            frames: outputs.len() as u32,
            // The mean of `count` frames still contains that part of their noise.
            bias: pool(&errors)? - variance / count,
            variance,
        })
    }
}
