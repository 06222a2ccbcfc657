//! The truth, ready to measure any number of pictures against.

use frame::{Frame, Image, Ladder, Picture, Plane, Raster, Truth, regions};
use rayon::prelude::*;

use crate::check::{check_agreement, check_brightness, check_picture, check_viewing};
use crate::color::absolute_error::absolute_error;
use crate::color::error_maps::{ErrorMaps, MoreMaps};
use crate::color::frozen::FrozenReference;
use crate::color::pooled::Pooled;
use crate::color::pooled_scores::{Found, image_scores, label_scores};
use crate::color::pooling::mean;
use crate::color::ssim::SSIM_BORDER;
use crate::equivalent::{Curve, Equivalent};
use crate::ladder::Curves;
use crate::object::reference::ObjectReference;
use crate::probes::{ProbeMaps, ProbeMeasurement, Probes, measure_probes};
use crate::skill::{Ends, skill_scores};
use crate::{
    EquivalentScores, ImageScores, Maps, MeasureError, Measured, ProbeScores, Region, Regions,
    Scores, Viewing,
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
    /// Floors: from the errors of the truth's first half against the mean, whose difference is as large as the mean's own
    /// noise.
    noise: [Option<Pooled>; Region::ALL.len()],
    /// The same of its labels, pixel by pixel.
    label_noise: Raster<f64>,
    /// The picture that does nothing.
    instant: Image,
    /// The two pictures that skill lies between.
    ends: Ends,
    /// Pixels whose SSIM window lies in the picture.
    windows: Raster<bool>,
    frozen: FrozenReference,
    pub(crate) objects: Vec<ObjectReference>,
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
        check_brightness(&instant, viewing, "the frame")?;
        for (half, name) in truth.halves.iter().zip(["A", "B"]) {
            let what = format!("half {name} of the truth");
            check_picture(half, truth, &what)?;
            check_brightness(half, viewing, &what)?;
        }
        let mean = truth.mean();
        let regions = regions(truth);
        let windows = whole_windows(truth.size());
        let halves = truth.halves.each_ref().map(|half| &half.color);
        let noise = ErrorMaps::new(&truth.halves[0], [&mean.color; 2], &mean, viewing);
        let instant_errors = ErrorMaps::new(&instant, halves, &mean, viewing);
        Ok(Self {
            noise: Region::ALL.map(|region| Pooled::of_noise(&noise, &regions, region, &windows)),
            label_noise: noise.label,
            ends: Ends {
                nothing: Pooled::new(&instant_errors, &regions, Region::Moving, &windows),
                best: None,
            },
            windows,
            frozen: FrozenReference::new(truth, &regions, viewing),
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

    /// Names the picture of the one-frame oracle, the best that one frame can give: it has a skill of 1. Without it no picture
    /// has any.
    pub fn with_best(mut self, best: &Picture) -> Result<Self, MeasureError> {
        check_picture(best, self.truth, "the one-frame oracle")?;
        let errors = ErrorMaps::new(best, self.half_colors(), &self.mean, &self.viewing);
        self.ends.best = Pooled::new(&errors, &self.regions, Region::Moving, &self.windows);
        Ok(self)
    }

    /// Measures one picture.
    pub fn measure(&self, output: &Picture) -> Result<Measurement, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        check_brightness(output, &self.viewing, "the output")?;
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
            let variations = [&errors.label, &self.label_noise];
            object.measure(matte, variations, gradient.as_ref(), &self.regions)
        });
        let (frozen, frozen_squared) =
            self.frozen
                .measure(&output.color, &self.regions, &self.viewing);
        let static_change = self.static_change(&output.color);
        let pooled = Region::ALL.map(|region| self.pooled(&errors, region));
        let [moving, support, still, full, knowable, unknowable] = &pooled;
        Ok(Measurement {
            scores: Scores {
                moving: image_scores(moving),
                support: image_scores(support),
                still: image_scores(still),
                full: image_scores(full),
                knowable: image_scores(knowable),
                unknowable: image_scores(unknowable),
                frozen,
                static_contamination: match mean(
                    &self.regions.select(Region::Still, &static_change),
                ) {
                    // The instant is exact there: the picture is compared with what the filter was given.
                    Some(change) => Measured::score(change, 0.0),
                    None => Measured::not_applicable(empty(Region::Still)),
                },
                label_total_variation: label_scores(moving),
                objects: objects.collect(),
                probes: ProbeScores::not_applicable("no probes were run through the filter"),
                skill: skill_scores(moving, &self.ends),
                equivalent_subframes: self.equivalent_scores(moving),
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
        check_brightness(output, &self.viewing, "the output")?;
        let errors = ErrorMaps::new(output, self.half_colors(), &self.mean, &self.viewing);
        Ok(image_scores(&self.pooled(&errors, Region::Moving)))
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

    fn pooled(&self, errors: &ErrorMaps, region: Region) -> Found {
        let pooled = Pooled::new(errors, &self.regions, region, &self.windows);
        let noise = self.noise[Region::ALL
            .iter()
            .position(|other| *other == region)
            .expect("Region::ALL holds every region")];
        pooled.zip(noise).ok_or(empty(region))
    }

    /// Change of the instant's colour where nothing moves; 0 elsewhere.
    fn static_change(&self, output: &Image) -> Raster<f64> {
        absolute_error(output, &self.instant, self.viewing.scale()).zip(
            &self.regions.still,
            |change, still| if *still { *change } else { 0.0 },
        )
    }

    fn equivalent_scores(&self, moving: &Found) -> EquivalentScores {
        type Of<T> = fn(&Curves) -> &T;
        let place = |curve: Of<Option<Curve>>, error: fn(&Pooled) -> f64| {
            let Some(curves) = &self.curves else {
                return Equivalent::refused("no ladder of accumulations was given");
            };
            match (moving, curve(curves)) {
                (Ok((own, noise)), Some(curve)) => {
                    Equivalent::Subframes(curve.place(error(own), error(noise)))
                }
                (Ok(_), None) => Equivalent::refused("no accumulation can be told from the truth"),
                (Err(reason), _) => Equivalent::refused(reason),
            }
        };
        EquivalentScores {
            mse: place(|curves| &curves.mse, |pooled| pooled.mse),
            flip: place(|curves| &curves.flip, |pooled| pooled.flip),
            label_total_variation: place(|curves| &curves.label, |pooled| pooled.label),
        }
    }
}

/// Pixels whose SSIM window lies in the picture.
fn whole_windows((width, height): (u32, u32)) -> Raster<bool> {
    Raster::from_fn(width, height, |x, y| {
        x.min(y) >= SSIM_BORDER && x + SSIM_BORDER < width && y + SSIM_BORDER < height
    })
}

fn empty(region: Region) -> &'static str {
    match region {
        Region::Moving | Region::Support => "nothing moves on screen",
        Region::Still => "no pixel stands still",
        Region::Full => "the picture has no pixel",
        Region::Knowable => "no moving pixel is seen whole in the frame of the instant",
        Region::Unknowable => "the frame of the instant shows all that the shutter sees",
    }
}
