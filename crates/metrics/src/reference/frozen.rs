//! The truth with shading frozen at the instant, which leaves only errors of visibility.

use frame::{Image, Raster, Region, Regions, Truth};

use crate::color::cross_error::{cross, scatter, squared_error};
use crate::color::flip::{Displayed, SeenExposures};
use crate::math::pooling::mean_over;
use crate::math::raster::zip_pixels;
use crate::{FrozenScores, Measured, Viewing};

/// The frozen-shading truth, ready to score any number of pictures.
pub struct FrozenReference {
    /// The mean as FLIP sees it.
    seen: SeenExposures,
    halves: [Image; 2],
    /// Scores of its own noise over the moving region.
    noise: Option<[f64; 2]>,
    /// Difference of the two truths over the moving region.
    shading: Measured,
}

impl FrozenReference {
    /// Prepares the frozen-shading truth with this mean.
    pub fn new(truth: &Truth, mean: &Image, regions: &Regions, viewing: &Viewing) -> Self {
        let halves = truth.frozen_halves();
        let seen = SeenExposures::of_display(&Displayed::new(mean, viewing));
        let squared = squared_error(&halves[0], [mean; 2], viewing.scale());
        let flip = seen.map_errors(&Displayed::new(&halves[0], viewing).linear);
        Self {
            noise: pool_scatter(&squared, regions)
                .zip(pool(&flip, regions))
                .map(<[f64; 2]>::from),
            shading: measure_shading(truth, &halves, regions, viewing),
            seen,
            halves,
        }
    }

    /// Returns the halves of the truth with frozen shading.
    pub fn halves(&self) -> [&Image; 2] {
        self.halves.each_ref()
    }

    /// Scores a picture, also given as displayed, by its squared error against `halves`; returns
    /// that error, too.
    pub fn measure(
        &self,
        output: &Image,
        displayed: &Displayed,
        halves: [&Image; 2],
        regions: &Regions,
        viewing: &Viewing,
    ) -> (FrozenScores, Raster<f64>) {
        let squared = squared_error(output, halves, viewing.scale());
        let flip = self.seen.map_errors(&displayed.linear);
        let found = [pool(&squared, regions), pool(&flip, regions)];
        let score = |which: usize| {
            let noise = self.noise.map(|noise| noise[which]);
            Measured::of(found[which], noise, NOTHING_MOVES)
        };
        let scores = FrozenScores {
            mse: score(0),
            flip: score(1),
            shading: self.shading.clone(),
        };
        (scores, squared)
    }
}

const NOTHING_MOVES: &str = "nothing moves on screen";

/// Measures `(A - A')(B - B')`, A' and B' being the frozen halves. It scatters about 0 by its
/// floor if shading does not change.
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
        zip_pixels(colors[half], &frozen[half], |color, frozen| -> [f32; 3] {
            std::array::from_fn(|c| color[c] - frozen[c])
        })
    });
    let noise = squared_error(&differences[0], [&differences[1]; 2], 0.5 * scale);
    let (value, floor) = (pool(&product, regions), pool_scatter(&noise, regions));
    Measured::of(value, floor, NOTHING_MOVES)
}

fn pool_scatter(noise: &Raster<f64>, regions: &Regions) -> Option<f64> {
    let moving = regions.indices(Region::Moving);
    scatter(moving.map(|at| noise.pixels[at]))
}

fn pool<T: Copy + Into<f64>>(map: &Raster<T>, regions: &Regions) -> Option<f64> {
    mean_over(map, regions, Region::Moving)
}
