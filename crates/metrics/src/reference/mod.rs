//! The truth, ready to measure any number of pictures against.

mod check;
mod frozen;
mod jitter;
mod lateral_bleed;
mod measurement;

use frame::{Frame, Image, Ladder, Picture, Plane, Raster, Truth, regions};
use rayon::prelude::*;

use crate::color::absolute_error::absolute_error;
use crate::color::ssim::SSIM_BORDER;
use crate::math::pooling::mean;
use crate::object::reference::ObjectReference;
use crate::picture::error_maps::{ErrorMaps, MoreMaps};
use crate::picture::pooled::Pooled;
use crate::picture::scores::{Found, score_image, score_labels};
use crate::probe::{ProbeMeasurement, Probes, measure_probes};
use crate::subframes::Equivalent;
use crate::worth::curve::Curve;
use crate::worth::ladder::Curves;
use crate::worth::skill::{Ends, score_skill};
use crate::{
    EquivalentScores, ImageScores, MeasureError, Measured, ProbeScores, Region, Regions, Scores,
    Viewing,
};
use check::{check_agreement, check_brightness, check_picture, check_viewing};
use frozen::FrozenReference;

pub use jitter::Jitter;
pub use measurement::Measurement;

/// A truth, with everything that does not depend on the picture to be measured.
pub struct Reference<'a> {
    /// Pixels that scores are pooled over.
    pub regions: Regions,
    truth: &'a Truth,
    mean: Picture,
    viewing: Viewing,
    /// Noise floors of every region, from the errors of the truth's first half against the mean: the two differ by as much as the
    /// mean's own noise.
    noise: [Option<Pooled>; Region::ALL.len()],
    /// Errors of the first half's labels.
    label_noise: Raster<f64>,
    /// The instant: the picture of a filter that does nothing.
    instant: Image,
    /// The two pictures that skill lies between.
    ends: Ends,
    /// Pixels whose SSIM window lies in the picture.
    windows: Raster<bool>,
    frozen: FrozenReference,
    pub(crate) objects: Vec<ObjectReference>,
    curves: Option<Curves>,
    /// Listener to the end of each part of measuring, by the part's name.
    ended: fn(&'static str),
}

impl<'a> Reference<'a> {
    /// Checks that frame, truth and ladder belong together, and measures noise and ladder.
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
        check_brightness(&instant, viewing, "the frame")?;
        for (half, name) in truth.halves.iter().zip(["A", "B"]) {
            let what = format!("half {name} of the truth");
            check_picture(half, truth, &what)?;
            check_brightness(half, viewing, &what)?;
        }
        let mean = truth.mean();
        let masks = regions(truth);
        let windows = mark_whole_windows(truth.size());
        let halves = truth.halves.each_ref().map(|half| &half.color);
        let noise = ErrorMaps::new(&truth.halves[0], [&mean.color; 2], &mean, viewing, |_| ());
        let instant_errors = ErrorMaps::new(&instant, halves, &mean, viewing, |_| ());
        Ok(Self {
            noise: Region::ALL.map(|region| Pooled::of_noise(&noise, &masks, region, &windows)),
            label_noise: noise.label,
            ends: Ends {
                nothing: Pooled::new(&instant_errors, &masks, Region::Moving, &windows),
                best: None,
            },
            windows,
            frozen: FrozenReference::new(truth, &masks, viewing),
            objects: (1..truth.objects.len())
                .into_par_iter()
                .map(|id| ObjectReference::new(frame, truth, &mean, id))
                .collect(),
            curves: ladder.map(|ladder| Curves::new(ladder, truth, &mean, &masks, viewing)),
            regions: masks,
            truth,
            mean,
            instant: instant.color,
            viewing: *viewing,
            ended: |_| (),
        })
    }

    /// Adds the picture of the one-frame oracle, the best that one frame can give: it has a skill of 1. Without it skill does not
    /// apply.
    pub fn with_best(mut self, best: &Picture) -> Result<Self, MeasureError> {
        check_picture(best, self.truth, "the one-frame oracle")?;
        let errors = ErrorMaps::new(best, self.half_colors(), &self.mean, &self.viewing, |_| ());
        self.ends.best = Pooled::new(&errors, &self.regions, Region::Moving, &self.windows);
        Ok(self)
    }

    /// Tells a listener of the end of each part of measuring a picture, by the part's name.
    pub fn with_listener(mut self, ended: fn(&'static str)) -> Self {
        self.ended = ended;
        self
    }

    /// Measures one picture.
    pub fn measure(&self, output: &Picture) -> Result<Measurement, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        check_brightness(output, &self.viewing, "the output")?;
        (self.ended)("checks");
        let errors = ErrorMaps::new(
            output,
            self.half_colors(),
            &self.mean,
            &self.viewing,
            self.ended,
        );
        let pairs = || self.objects.iter().zip(&output.coverage[1..]);
        let nothing: Plane = errors.label.map(|_| 0.0);
        let bleed = pairs().fold(nothing.clone(), |sum: Plane, (object, matte)| {
            sum.zip(&object.map_bleed(matte), |sum, bleed| sum + bleed)
        });
        let gradients: Vec<Option<Raster<f64>>> = pairs()
            .map(|(object, matte)| object.map_gradient_errors(matte))
            .collect();
        let gradient_error = gradients.iter().flatten().fold(nothing, |sum, errors| {
            sum.zip(errors, |sum, error| sum + *error as f32)
        });
        let objects = pairs().zip(&gradients).map(|((object, matte), gradient)| {
            let variations = [&errors.label, &self.label_noise];
            object.measure(matte, variations, gradient.as_ref(), &self.regions)
        });
        let objects = objects.collect();
        (self.ended)("objects");
        let (frozen, frozen_squared) =
            self.frozen
                .measure(&output.color, &self.regions, &self.viewing);
        (self.ended)("frozen truth");
        let static_change = self.map_static_change(&output.color);
        (self.ended)("other maps");
        let pooled = Region::ALL.map(|region| self.pool(&errors, region));
        (self.ended)("pooling");
        let [moving, support, still, full, knowable, unknowable] = &pooled;
        Ok(Measurement {
            scores: Scores {
                moving: score_image(moving),
                support: score_image(support),
                still: score_image(still),
                full: score_image(full),
                knowable: score_image(knowable),
                unknowable: score_image(unknowable),
                frozen,
                static_contamination: match mean(
                    &self.regions.select(Region::Still, &static_change),
                ) {
                    // The instant is exact there: the picture is compared with what the filter was given.
                    Some(change) => Measured::score(change, 0.0),
                    None => Measured::not_applicable(explain_empty(Region::Still)),
                },
                label_total_variation: score_labels(moving),
                objects,
                probes: ProbeScores::not_applicable("no probes were run through the filter"),
                skill: score_skill(moving, &self.ends),
                equivalent_subframes: self.score_equivalents(moving),
            },
            maps: errors.to_maps(
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

    /// Measures the errors of colour over what moves, and nothing else of [`Reference::measure`].
    pub fn measure_moving(&self, output: &Picture) -> Result<ImageScores, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        check_brightness(output, &self.viewing, "the output")?;
        let errors = ErrorMaps::new(
            output,
            self.half_colors(),
            &self.mean,
            &self.viewing,
            |_| (),
        );
        Ok(score_image(&self.pool(&errors, Region::Moving)))
    }

    /// Scores what a filter made of [`Probes::images`]; its weights must be those of the measured picture.
    pub fn measure_probes(&self, probes: &Probes) -> ProbeMeasurement {
        measure_probes(probes, self.truth, &self.regions)
    }

    pub(crate) fn viewing(&self) -> &Viewing {
        &self.viewing
    }

    /// Returns the colours of the truth's halves.
    pub(crate) fn half_colors(&self) -> [&Image; 2] {
        self.truth.halves.each_ref().map(|half| &half.color)
    }

    fn pool(&self, errors: &ErrorMaps, region: Region) -> Found {
        let pooled = Pooled::new(errors, &self.regions, region, &self.windows);
        let noise = self.noise[Region::ALL
            .iter()
            .position(|other| *other == region)
            .expect("Region::ALL holds every region")];
        pooled.zip(noise).ok_or(explain_empty(region))
    }

    /// Maps the change of the instant's colour where nothing moves; 0 elsewhere.
    fn map_static_change(&self, output: &Image) -> Raster<f64> {
        absolute_error(output, &self.instant, self.viewing.scale()).zip(
            &self.regions.still,
            |change, still| if *still { *change } else { 0.0 },
        )
    }

    fn score_equivalents(&self, moving: &Found) -> EquivalentScores {
        type Of<T> = fn(&Curves) -> &T;
        let score = |curve: Of<Option<Curve>>, error: fn(&Pooled) -> f64| {
            let Some(curves) = &self.curves else {
                return Equivalent::not_applicable("no ladder of accumulations was given");
            };
            match (moving, curve(curves)) {
                (Ok((own, noise)), Some(curve)) => {
                    Equivalent::Subframes(curve.convert(error(own), error(noise)))
                }
                (Ok(_), None) => {
                    Equivalent::not_applicable("no accumulation can be told from the truth")
                }
                (Err(reason), _) => Equivalent::not_applicable(reason),
            }
        };
        EquivalentScores {
            mse: score(|curves| &curves.mse, |pooled| pooled.mse),
            flip: score(|curves| &curves.flip, |pooled| pooled.flip),
            label_total_variation: score(|curves| &curves.label, |pooled| pooled.label),
        }
    }
}

/// Marks the pixels whose SSIM window lies in the picture.
fn mark_whole_windows((width, height): (u32, u32)) -> Raster<bool> {
    Raster::from_fn(width, height, |x, y| {
        x.min(y) >= SSIM_BORDER && x + SSIM_BORDER < width && y + SSIM_BORDER < height
    })
}

fn explain_empty(region: Region) -> &'static str {
    match region {
        Region::Moving | Region::Support => "nothing moves on screen",
        Region::Still => "no pixel stands still",
        Region::Full => "the picture has no pixel",
        Region::Knowable => "no moving pixel is seen whole in the frame of the instant",
        Region::Unknowable => "the frame of the instant shows all that the shutter sees",
    }
}
