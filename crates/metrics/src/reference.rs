//! The truth, ready to measure any number of pictures against.

use frame::{Frame, Image, Ladder, Picture, Plane, Raster, Truth, regions};
use rayon::prelude::*;

use crate::check::{check_agreement, check_picture, check_viewing};
use crate::cross_error::{psnr, uncertainty};
use crate::equivalent::{Curve, Equivalent};
use crate::error_maps::ErrorMaps;
use crate::ladder::Curves;
use crate::object::ObjectReference;
use crate::pooling::{mean, percentile_95};
use crate::{
    EquivalentScores, ImageScores, LabelScores, Maps, MeasureError, Measured, Region, Regions,
    Scores, Viewing,
};

/// Scores, and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// The numbers.
    pub scores: Scores,
    /// The pictures.
    pub maps: Maps,
}

/// Everything about a truth that does not depend on the picture to be measured.
pub struct Reference<'a> {
    /// Which pixels the scores are pooled over.
    pub regions: Regions,
    truth: &'a Truth,
    mean: Picture,
    viewing: Viewing,
    /// Errors of the truth's first half against the mean: their difference is as large as the mean's own noise.
    noise: ErrorMaps,
    /// Standard error of the unbiased squared error over the moving region, from the truth's noise.
    mse_uncertainty: f64,
    objects: Vec<ObjectReference>,
    curves: Option<Curves>,
}

impl<'a> Reference<'a> {
    /// Checks that frame, truth and ladder belong together, and scores what needs no picture: noise and ladder.
    pub fn new(
        frame: &Frame,
        truth: &'a Truth,
        ladder: Option<&Ladder>,
        viewing: &Viewing,
    ) -> Result<Self, MeasureError> {
        check_viewing(viewing)?;
        check_agreement(frame, truth, ladder)?;
        let instant = Picture {
            color: frame.color.clone(),
            coverage: frame.coverage.clone(),
        };
        check_picture(&instant, truth, "the frame")?;
        for (half, name) in truth.halves.iter().zip(["A", "B"]) {
            check_picture(half, truth, &format!("half {name} of the truth"))?;
        }
        let mean = truth.mean();
        let regions = regions(truth);
        Ok(Self {
            noise: ErrorMaps::new(&truth.halves[0], [&mean.color; 2], &mean, viewing),
            mse_uncertainty: uncertainty(
                &regions.select(Region::Moving, &truth.halves[0].color),
                &regions.select(Region::Moving, &truth.halves[1].color),
                viewing.scale(),
            ),
            objects: (1..truth.objects.len())
                .into_par_iter()
                .map(|id| ObjectReference::new(frame, truth, &mean, id))
                .collect(),
            curves: ladder.map(|ladder| Curves::new(ladder, truth, &mean, &regions, viewing)),
            regions,
            truth,
            mean,
            viewing: *viewing,
        })
    }

    /// Measures one picture.
    pub fn measure(&self, output: &Picture) -> Result<Measurement, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        let errors = ErrorMaps::new(output, self.half_colors(), &self.mean, &self.viewing);
        let pairs = || self.objects.iter().zip(&output.coverage[1..]);
        let objects = pairs().map(|(object, matte)| {
            let region = &self.regions.moving;
            object.measure(matte, &errors.label, &self.noise.label, region)
        });
        let nothing = errors.label.map(|_| 0.0);
        let bleed = pairs().fold(nothing, |sum: Plane, (object, matte)| {
            sum.zip(&object.bleed_map(matte), |sum, bleed| sum + bleed)
        });
        Ok(Measurement {
            scores: Scores {
                moving: self.image_scores(&errors, Region::Moving),
                still: self.image_scores(&errors, Region::Still),
                full: self.image_scores(&errors, Region::Full),
                label_total_variation: self.label_scores(&errors),
                objects: objects.collect(),
                equivalent_subframes: self.equivalent_scores(&errors),
            },
            maps: errors.maps(output, &self.mean, bleed),
        })
    }

    pub(crate) fn viewing(&self) -> &Viewing {
        &self.viewing
    }

    /// The colours of the truth's halves.
    pub(crate) fn half_colors(&self) -> [&Image; 2] {
        self.truth.halves.each_ref().map(|half| &half.color)
    }

    fn image_scores(&self, errors: &ErrorMaps, region: Region) -> ImageScores {
        let pool = |map, how| self.pool(errors, region, map, how);
        let mse = pool(|maps| &maps.squared, mean);
        ImageScores {
            mse: score(mse, region),
            psnr: score(
                mse.map(|(mse, noise)| (psnr(mse, noise), psnr(noise, noise))),
                region,
            ),
            relmse: score(pool(|maps| &maps.relative, mean), region),
            flip: score(pool(|maps| &maps.flip, mean), region),
            flip_p95: score(pool(|maps| &maps.flip, percentile_95), region),
            flip_hdr: score(pool(|maps| &maps.flip_hdr, mean), region),
        }
    }

    fn label_scores(&self, errors: &ErrorMaps) -> LabelScores {
        let pool = |how| {
            let pooled = self.pool(errors, Region::Moving, |maps| &maps.label, how);
            score(pooled, Region::Moving)
        };
        LabelScores {
            mean: pool(mean),
            p95: pool(percentile_95),
        }
    }

    fn equivalent_scores(&self, errors: &ErrorMaps) -> EquivalentScores {
        let place = |curve: fn(&Curves) -> &Option<Curve>, pooled: Option<(f64, f64)>| {
            let Some(curves) = &self.curves else {
                return Equivalent::refused("no ladder of accumulations was given");
            };
            let Some((error, noise)) = pooled else {
                return Equivalent::refused(empty(Region::Moving));
            };
            match curve(curves) {
                Some(curve) => Equivalent::Subframes(curve.place(error, noise)),
                None => Equivalent::refused("no accumulation can be told from the truth"),
            }
        };
        let pool = |map| self.pool(errors, Region::Moving, map, mean);
        let mse = pool(|maps| &maps.squared).map(|(error, _)| (error, self.mse_uncertainty));
        EquivalentScores {
            mse: place(|curves| &curves.mse, mse),
            flip: place(|curves| &curves.flip, pool(|maps| &maps.flip)),
            label_total_variation: place(|curves| &curves.label, pool(|maps| &maps.label)),
        }
    }

    /// A pooled error and the noise in it; none over an empty region.
    fn pool(
        &self,
        errors: &ErrorMaps,
        region: Region,
        map: fn(&ErrorMaps) -> &Raster<f64>,
        how: fn(&[f64]) -> Option<f64>,
    ) -> Option<(f64, f64)> {
        let value = how(&self.regions.select(region, map(errors)))?;
        let noise = how(&self.regions.select(region, map(&self.noise)))?;
        Some((value, noise))
    }
}

fn score(pooled: Option<(f64, f64)>, region: Region) -> Measured {
    match pooled {
        Some((value, noise)) => Measured::score(value, noise),
        None => Measured::not_applicable(empty(region)),
    }
}

fn empty(region: Region) -> &'static str {
    match region {
        Region::Moving => "nothing moves on screen",
        Region::Still => "no pixel stands still",
        Region::Full => "the picture has no pixel",
    }
}
