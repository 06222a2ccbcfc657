//! The truth, ready to measure any number of pictures against.

use frame::{Frame, Image, Ladder, Picture, Plane, Raster, Truth, regions};
use rayon::prelude::*;

use crate::absolute_error::absolute_error;
use crate::check::{check_agreement, check_picture, check_viewing};
use crate::cross_error::{psnr, uncertainty};
use crate::equivalent::{Curve, Equivalent};
use crate::error_maps::{ErrorMaps, MoreMaps};
use crate::frozen::FrozenReference;
use crate::ladder::Curves;
use crate::object::ObjectReference;
use crate::pooling::{mean, percentile_95, percentile_99, weighted_median};
use crate::probes::{ProbeMaps, ProbeMeasurement, Probes, measure_probes};
use crate::ssim::SSIM_BORDER;
use crate::{
    EquivalentScores, ImageScores, LabelScores, Maps, MeasureError, Measured, ProbeScores, Region,
    Regions, Scores, SkillScores, Viewing,
};

/// Scores, and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// The numbers.
    pub scores: Scores,
    /// The pictures.
    pub maps: Maps,
    /// Those of probes, where any were run.
    pub probes: Option<ProbeMaps>,
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
    /// The picture that does nothing, and its errors.
    instant: Image,
    instant_errors: ErrorMaps,
    frozen: FrozenReference,
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
            instant_errors: ErrorMaps::new(
                &instant,
                truth.halves.each_ref().map(|half| &half.color),
                &mean,
                viewing,
            ),
            frozen: FrozenReference::new(truth, &regions, viewing),
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
            instant: instant.color,
            viewing: *viewing,
        })
    }

    /// Measures one picture.
    pub fn measure(&self, output: &Picture) -> Result<Measurement, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        let errors = ErrorMaps::new(output, self.half_colors(), &self.mean, &self.viewing);
        let pairs = || self.objects.iter().zip(&output.coverage[1..]);
        let nothing: Plane = errors.label.map(|_| 0.0);
        let bleed = pairs().fold(nothing.clone(), |sum: Plane, (object, matte)| {
            sum.zip(&object.bleed_map(matte), |sum, bleed| sum + bleed)
        });
        let gradients: Vec<Option<Raster<f64>>> = pairs()
            .map(|(object, matte)| object.gradient_errors(matte))
            .collect();
        let gradient_error = gradients.iter().flatten().fold(nothing, |sum, errors| {
            sum.zip(errors, |sum, error| sum + *error as f32)
        });
        let objects = pairs().zip(&gradients).map(|((object, matte), gradient)| {
            let variations = [&errors.label, &self.noise.label];
            object.measure(matte, variations, gradient.as_ref(), &self.regions)
        });
        let (frozen, frozen_squared) =
            self.frozen
                .measure(&output.color, &self.regions, &self.viewing);
        let static_change = self.static_change(&output.color);
        Ok(Measurement {
            scores: Scores {
                moving: self.image_scores(&errors, Region::Moving),
                still: self.image_scores(&errors, Region::Still),
                full: self.image_scores(&errors, Region::Full),
                knowable: self.image_scores(&errors, Region::Knowable),
                unknowable: self.image_scores(&errors, Region::Unknowable),
                frozen,
                static_contamination: match mean(
                    &self.regions.select(Region::Still, &static_change),
                ) {
                    // The instant is exact there: the picture is compared with what the filter was given.
                    Some(change) => Measured::score(change, 0.0),
                    None => Measured::not_applicable(empty(Region::Still)),
                },
                label_total_variation: self.label_scores(&errors),
                objects: objects.collect(),
                probes: ProbeScores::not_applicable("no probes were run through the filter"),
                skill: self.skill_scores(&errors),
                equivalent_subframes: self.equivalent_scores(&errors),
            },
            maps: errors.maps(
                output,
                &self.mean,
                MoreMaps {
                    bleed,
                    gradient_error,
                    frozen_squared,
                    static_change,
                },
            ),
            probes: None,
        })
    }

    /// The errors of colour over what moves, and nothing else of [`Reference::measure`].
    pub fn measure_moving(&self, output: &Picture) -> Result<ImageScores, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        let errors = ErrorMaps::new(output, self.half_colors(), &self.mean, &self.viewing);
        Ok(self.image_scores(&errors, Region::Moving))
    }

    /// Scores what a filter made of [`Probes::images`]; its weights have to be those of the measured picture.
    pub fn measure_probes(&self, probes: &Probes) -> ProbeMeasurement {
        measure_probes(probes, self.truth, &self.regions)
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
            mae: score(pool(|maps| &maps.absolute, mean), region),
            smape: score(pool(|maps| &maps.symmetric, mean), region),
            flip: score(pool(|maps| &maps.flip, mean), region),
            flip_median: score(pool(|maps| &maps.flip, weighted_median), region),
            flip_p95: score(pool(|maps| &maps.flip, percentile_95), region),
            flip_p99: score(pool(|maps| &maps.flip, percentile_99), region),
            flip_hdr: score(pool(|maps| &maps.flip_hdr, mean), region),
            ssim: self.ssim_score(errors, region),
        }
    }

    /// Windows that reach beyond the picture are left out.
    fn ssim_score(&self, errors: &ErrorMaps, region: Region) -> Measured {
        let [width, height] = [self.mean.color.width, self.mean.color.height];
        let interior = Raster::from_fn(width, height, |x, y| {
            x.min(y) >= SSIM_BORDER && x + SSIM_BORDER < width && y + SSIM_BORDER < height
        });
        let whole = self.regions.select(region, &interior);
        let pool = |map| {
            let values = self.regions.select(region, map).into_iter().zip(&whole);
            let values: Vec<f64> = values.filter_map(|(v, whole)| whole.then_some(v)).collect();
            mean(&values)
        };
        match (pool(&errors.ssim), pool(&self.noise.ssim)) {
            (Some(value), Some(noise)) => Measured::score(value, noise),
            _ => Measured::not_applicable(empty(region)),
        }
    }

    /// How much a picture changes what stands still.
    fn static_change(&self, output: &Image) -> Raster<f64> {
        absolute_error(output, &self.instant, self.viewing.scale()).zip(
            &self.regions.still,
            |change, still| if *still { *change } else { 0.0 },
        )
    }

    fn skill_scores(&self, errors: &ErrorMaps) -> SkillScores {
        let skill = |map: fn(&ErrorMaps) -> &Raster<f64>| {
            let Some((error, noise)) = self.pool(errors, Region::Moving, map, mean) else {
                return Measured::not_applicable(empty(Region::Moving));
            };
            match mean(
                &self
                    .regions
                    .select(Region::Moving, map(&self.instant_errors)),
            ) {
                Some(none) if none > noise => {
                    Measured::score(1.0 - error / none, 1.0 - noise / none)
                }
                _ => Measured::not_applicable(
                    "the instant itself is no worse than the truth's noise",
                ),
            }
        };
        SkillScores {
            mse: skill(|maps| &maps.squared),
            flip: skill(|maps| &maps.flip),
            label_total_variation: skill(|maps| &maps.label),
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
        Region::Knowable => "no moving pixel is seen whole in the frame of the instant",
        Region::Unknowable => "the frame of the instant shows all that the shutter sees",
    }
}
