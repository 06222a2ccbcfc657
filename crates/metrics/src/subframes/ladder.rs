//! Errors of the accumulation ladder by number of sub-frames.

use frame::{Accumulation, Image, Picture, Raster};

use super::curve::Curve;
use crate::color::cross_error::cross;
use crate::color::flip::{Displayed, SeenExposures};
use crate::label::label_variation;
use crate::math::pooling::mean_over;
use crate::{Region, Regions, Viewing};

/// Kind of a rung's error, over the moving region.
#[derive(Clone, Copy)]
pub enum ErrorKind {
    /// Unbiased squared error of colour: neither the rungs' noise nor the truth's counts.
    Mse,
    /// Mean LDR-FLIP, noise of rung and truth included.
    Flip,
    /// Mean label total variation, noise included.
    Label,
}

/// Errors of the rungs that were added, by number of sub-frames.
#[derive(Default)]
pub struct Curves {
    /// Sub-frames, and the error of each [`ErrorKind`] in their order.
    rungs: Vec<(u32, [f64; 3])>,
}

impl Curves {
    /// Scores a rung against the truth, which is given by its mean and the colours of its halves; `seen` is the mean as FLIP sees
    /// it. Rungs are added in rising order of sub-frames.
    pub fn add(
        &mut self,
        rung: &Accumulation,
        (mean, truths): (&Picture, [&Image; 2]),
        seen: &SeenExposures,
        regions: &Regions,
        viewing: &Viewing,
    ) {
        assert!(
            (self.rungs.last()).is_none_or(|(last, _)| *last < rung.subframes),
            "rungs rise"
        );
        let pool = |map: &Raster<f64>| mean_over(map, regions, Region::Moving).unwrap_or(0.0);
        let picture = Picture::mean(&rung.halves);
        let halves = rung.halves.each_ref().map(|half| &half.color);
        let flip = seen.map_errors(&Displayed::new(&picture.color, viewing).linear);
        let errors = [
            pool(&cross(halves, truths, viewing.scale())),
            mean_over(&flip, regions, Region::Moving).unwrap_or(0.0),
            pool(&label_variation(&picture.coverage, &mean.coverage)),
        ];
        self.rungs.push((rung.subframes, errors));
    }

    /// Returns whether no rung was added.
    pub fn is_empty(&self) -> bool {
        self.rungs.is_empty()
    }

    /// Makes the curve of one kind of error; none if no rung can be distinguished from the truth.
    pub fn curve(&self, kind: ErrorKind) -> Option<Curve> {
        let points: Vec<(u32, f64)> = (self.rungs.iter())
            .map(|(subframes, errors)| (*subframes, errors[kind as usize]))
            .collect();
        Curve::new(&points)
    }
}
