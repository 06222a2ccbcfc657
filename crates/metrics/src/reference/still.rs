//! What a filter changes where nothing moves.

use frame::{Image, Raster};

use super::{Reference, explain_empty};
use crate::color::grain::{BRIGHTNESS_EPSILON, brightness};
use crate::math::pooling::mean;
use crate::math::raster::index_pixels;
use crate::{Measured, Region};

impl Reference<'_> {
    /// Maps the change of the instant's colour where nothing moves, relative to its brightness; 0
    /// elsewhere.
    pub(super) fn map_static_change(&self, output: &Image) -> Raster<f64> {
        let scale = self.viewing.scale();
        index_pixels(output, |at| {
            if !self.regions.still.pixels[at] {
                return 0.0;
            }
            let [f, i] = [output, &self.instant].map(|image| image.pixels[at]);
            let change = std::array::from_fn(|c| f[c] - i[c]);
            brightness(change, scale) / (brightness(i, scale) + BRIGHTNESS_EPSILON)
        })
    }

    /// Scores the map: its root mean square. The instant is exact there, as the filter's own input,
    /// so that there is no noise.
    pub(super) fn score_static_change(&self, change: &Raster<f64>) -> Measured {
        let still = self.regions.indices(Region::Still);
        let square = mean(still.map(|at| change.pixels[at].powi(2)));
        Measured::of(
            square.map(f64::sqrt),
            Some(0.0),
            explain_empty(Region::Still),
        )
    }
}
