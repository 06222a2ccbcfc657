//! Errors of the accumulation ladder by number of sub-frames.

use frame::{Accumulation, Image, Picture, Raster};
use serde::{Deserialize, Serialize};

use crate::color::cross_error::multiply;
use crate::color::flip::{Displayed, SeenExposures};
use crate::label::label_variation;
use crate::math::pooling::mean_over;
use crate::{Region, Regions, Viewing};

/// Errors over the moving region that sub-frames are counted by.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Unbiased squared error of colour.
    pub mse: f64,
    /// Mean LDR-FLIP.
    pub flip: f64,
    /// Mean label total variation.
    pub label: f64,
}

/// Kind of error that sub-frames are counted by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// [`Errors::mse`].
    Mse,
    /// [`Errors::flip`].
    Flip,
    /// [`Errors::label`].
    Label,
}

impl Errors {
    /// Returns one of the errors in squares: noise raises them by its variance, which the jackknife
    /// takes out.
    pub(super) fn square(&self, kind: ErrorKind) -> f64 {
        match kind {
            ErrorKind::Mse => self.mse,
            ErrorKind::Flip => self.flip.powi(2),
            ErrorKind::Label => self.label.powi(2),
        }
    }
}

/// Errors of a rung.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rung {
    /// Number of sub-frames.
    pub subframes: u32,
    /// Errors with as much of the truth's noise as a picture without noise of its own has:
    /// comparable with those.
    pub noisy: Errors,
    /// Errors without the truth's noise: those of the rung's picture on the truth's mean.
    pub plain: Errors,
}

/// Errors of the rungs that were added, in rising order of sub-frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Curves {
    /// The rungs.
    pub rungs: Vec<Rung>,
}

/// A truth that rungs are scored against.
pub struct RungTruth<'a> {
    /// Its mean.
    pub mean: &'a Picture,
    /// Half of it whose difference from the mean is as large as the mean's noise; the mean itself
    /// if the truth has no noise.
    pub half: &'a Picture,
    /// The mean as FLIP sees it.
    pub seen: &'a SeenExposures,
}

impl Curves {
    /// Scores a rung against the truth.
    ///
    /// A picture F differs from the truth's mean T by its error and the noise of T. A rung on T
    /// differs by its error alone, and would win by the noise. So it is also scored on the truth's
    /// half A, against T: A - T is as large as the noise of T.
    pub fn add(
        &mut self,
        rung: &Accumulation,
        truth: &RungTruth,
        regions: &Regions,
        viewing: &Viewing,
    ) {
        assert!(
            (self.rungs.last()).is_none_or(|last| last.subframes < rung.subframes),
            "rungs rise"
        );
        let difference = rung.difference();
        let mse = mean_square(rung, &difference.color, regions, viewing.scale());
        let score = |base: &Picture| {
            let picture = base.plus(&difference);
            let flip = (truth.seen).map_errors(&Displayed::new(&picture.color, viewing).linear);
            let label = label_variation(&picture.coverage, &truth.mean.coverage);
            Errors {
                mse,
                flip: pool(&flip, regions),
                label: pool(&label, regions),
            }
        };
        let plain = score(truth.mean);
        self.rungs.push(Rung {
            subframes: rung.subframes,
            noisy: if std::ptr::eq(truth.half, truth.mean) {
                plain
            } else {
                score(truth.half)
            },
            plain,
        });
    }

    /// Returns whether no rung was added.
    pub fn is_empty(&self) -> bool {
        self.rungs.is_empty()
    }
}

/// Estimates the mean square of a difference without the noise of its groups, mean over the
/// channels: the mean of the products of all pairs of different groups. The noise of one group
/// alone counts.
fn mean_square(rung: &Accumulation, mean: &Image, regions: &Regions, scale: f64) -> f64 {
    let square = |image: &Image| {
        let squares = image.map(|pixel| {
            let pixel = pixel.map(f64::from);
            multiply(pixel, pixel, scale)
        });
        pool(&squares, regions)
    };
    let whole = square(mean);
    let count = rung.groups.len() as f64;
    if rung.groups.len() == 1 {
        return whole;
    }
    let each = rung.groups.iter().map(|group| square(&group.color));
    (count * whole - each.sum::<f64>() / count) / (count - 1.0)
}

fn pool<T: Copy + Into<f64>>(map: &Raster<T>, regions: &Regions) -> f64 {
    mean_over(map, regions, Region::Moving).unwrap_or(0.0)
}
