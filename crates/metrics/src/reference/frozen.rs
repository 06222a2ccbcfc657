//! The truth whose shading stands still at the instant, against which only errors of visibility are left.

use frame::{Image, Raster, Region, Regions, Truth};

use crate::color::cross_error::{cross, scatter, squared_error};
use crate::color::flip::flip_ldr;
use crate::math::conversion::widen;
use crate::math::pooling::mean;
use crate::{FrozenScores, Measured, Viewing};

/// The frozen-shading truth, ready to score any number of pictures.
pub struct FrozenReference {
    mean: Image,
    halves: [Image; 2],
    /// Scores of its own noise over the moving region.
    noise: Option<[f64; 2]>,
    /// Difference of the two truths over the moving region.
    shading: Measured,
}

impl FrozenReference {
    /// Prepares the frozen-shading truth.
    pub fn new(truth: &Truth, regions: &Regions, viewing: &Viewing) -> Self {
        let mean = truth.at_instant_mean().frozen;
        let halves = truth.at_instant.each_ref().map(|half| half.frozen.clone());
        let mut reference = Self {
            noise: None,
            shading: measure_shading(truth, &halves, regions, viewing),
            mean,
            halves,
        };
        let against_itself = [&reference.mean; 2];
        let squared = squared_error(&reference.halves[0], against_itself, viewing.scale());
        let flip = reference.map_flip(&reference.halves[0], viewing);
        reference.noise = pool_scatter(&squared, regions)
            .zip(pool(&flip, regions))
            .map(<[f64; 2]>::from);
        reference
    }

    /// Scores a picture, and the squared error that its score was pooled from.
    pub fn measure(
        &self,
        output: &Image,
        regions: &Regions,
        viewing: &Viewing,
    ) -> (FrozenScores, Raster<f64>) {
        let halves = self.halves.each_ref();
        let squared = squared_error(output, halves, viewing.scale());
        let flip = self.map_flip(output, viewing);
        let score = |map: &Raster<f64>, which: usize| match (pool(map, regions), self.noise) {
            (Some(value), Some(noise)) => Measured::score(value, noise[which]),
            _ => Measured::not_applicable(NOTHING_MOVES),
        };
        let scores = FrozenScores {
            mse: score(&squared, 0),
            flip: score(&flip, 1),
            shading: self.shading.clone(),
        };
        (scores, squared)
    }

    fn map_flip(&self, output: &Image, viewing: &Viewing) -> Raster<f64> {
        widen(&flip_ldr(&self.mean, output, viewing))
    }
}

const NOTHING_MOVES: &str = "nothing moves on screen";

/// Measures `(A - A')(B - B')`, A' and B' being the frozen halves. It scatters about 0 by its floor if shading stands still.
fn measure_shading(
    truth: &Truth,
    frozen: &[Image; 2],
    regions: &Regions,
    viewing: &Viewing,
) -> Measured {
    let scale = viewing.scale();
    let colors = truth.halves.each_ref().map(|half| &half.color);
    let product = cross(colors, frozen.each_ref(), scale);
    let differences = [0, 1].map(|half| {
        colors[half].zip(&frozen[half], |color, frozen| -> [f32; 3] {
            std::array::from_fn(|c| color[c] - frozen[c])
        })
    });
    let noise = squared_error(&differences[0], [&differences[1]; 2], 0.5 * scale);
    match (pool(&product, regions), pool_scatter(&noise, regions)) {
        (Some(value), Some(noise)) => Measured::score(value, noise),
        _ => Measured::not_applicable(NOTHING_MOVES),
    }
}

fn pool_scatter(noise: &Raster<f64>, regions: &Regions) -> Option<f64> {
    scatter(&regions.select(Region::Moving, noise))
}

fn pool(map: &Raster<f64>, regions: &Regions) -> Option<f64> {
    mean(&regions.select(Region::Moving, map))
}
