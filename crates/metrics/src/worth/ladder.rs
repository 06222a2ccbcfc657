//! Errors of the accumulation ladder by number of sub-frames.

use frame::{Ladder, Picture, Raster, Truth};

use crate::color::cross_error::cross;
use crate::color::flip::{Displayed, SeenDisplay};
use crate::label::total_variation::label_variation;
use crate::math::pooling::mean_over;
use crate::worth::curve::Curve;
use crate::{Region, Regions, Viewing};

/// Errors over the moving region against the count of sub-frames.
pub struct Curves {
    /// Unbiased squared error of colour: neither the rungs' noise nor the truth's counts.
    pub mse: Option<Curve>,
    /// Mean LDR-FLIP, noise of rung and truth included.
    pub flip: Option<Curve>,
    /// Mean label total variation, noise included.
    pub label: Option<Curve>,
}

impl Curves {
    /// Scores every rung against the truth. `average` is the truth's mean, `seen` is it as FLIP sees it.
    pub fn new(
        ladder: &Ladder,
        truth: &Truth,
        (average, seen): (&Picture, &SeenDisplay),
        regions: &Regions,
        viewing: &Viewing,
    ) -> Self {
        let pool = |map: &Raster<f64>| mean_over(map, regions, Region::Moving).unwrap_or(0.0);
        let truths = truth.halves.each_ref().map(|half| &half.color);
        let errors: Vec<[f64; 3]> = (ladder.rungs.iter())
            .map(|rung| {
                let picture = Picture::mean(&rung.halves);
                let halves = rung.halves.each_ref().map(|half| &half.color);
                let flip = seen.map_errors(&Displayed::new(&picture.color, viewing));
                [
                    pool(&cross(halves, truths, viewing.scale())),
                    mean_over(&flip, regions, Region::Moving).unwrap_or(0.0),
                    pool(&label_variation(&picture.coverage, &average.coverage)),
                ]
            })
            .collect();
        let curve = |score: usize| {
            let counts = ladder.rungs.iter().map(|rung| rung.subframes);
            let points: Vec<(u32, f64)> = counts.zip(errors.iter().map(|e| e[score])).collect();
            Curve::new(&points)
        };
        Self {
            mse: curve(0),
            flip: curve(1),
            label: curve(2),
        }
    }
}
