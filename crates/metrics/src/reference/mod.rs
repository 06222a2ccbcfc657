//! The truth, ready to measure any number of pictures against.

mod accumulation;
mod check;
mod color;
mod counts;
mod frozen;
mod jitter;
mod lateral_bleed;
mod measurement;
mod shared_noise;
mod sharp;
mod still;
mod truth_errors;

use frame::{Frame, Image, Ladder, Picture, Plane, Raster, Size, Truth, regions};
use rayon::prelude::*;

use crate::color::flip::Displayed;
use crate::color::ssim::SSIM_BORDER;
use crate::object::reference::ObjectReference;
use crate::picture::error_maps::{ErrorMaps, MoreMaps};
use crate::picture::pooled::Pooled;
use crate::picture::scores::{Found, score_image, score_labels};
use crate::picture::seen_truth::SeenTruth;
use crate::probe::{OriginReference, ProbeMeasurement, Probes};
use crate::skill::score_skill;
use crate::{MeasureError, Measured, ObjectScores, ProbeScores, Region, Regions, Scores, Viewing};
use check::{check_agreement, check_brightness, check_picture, check_viewing};
use frozen::FrozenReference;
use shared_noise::halves_for;
pub use shared_noise::mark_shared;

pub use color::ColorReference;
pub use jitter::Jitter;
pub use measurement::Measurement;
pub use sharp::Sharp;
pub use truth_errors::TruthErrors;

const NO_INSTANT: &str =
    "an engine's sub-frames do not say where their surfaces were at the instant";
const NO_OBJECTS: &str = "an engine's sub-frames do not say which objects they show";

/// A truth, with everything that does not depend on the picture to be measured.
pub struct Reference<'a> {
    /// Pixels that scores are pooled over.
    pub regions: Regions,
    truth: &'a Truth,
    mean: Picture,
    /// The mean as a display shows it and as FLIP sees it.
    seen: SeenTruth,
    viewing: Viewing,
    errors: TruthErrors,
    /// The instant: the picture of a filter that does nothing.
    instant: Image,
    /// Pixels in which the instant has the truth's noise.
    shared: Raster<bool>,
    /// Pixels with their SSIM window in the picture.
    windows: Raster<bool>,
    frozen: FrozenReference,
    origins: OriginReference,
    pub(crate) objects: Vec<ObjectReference>,
}

impl<'a> Reference<'a> {
    /// Checks that frame, truth and ladder belong together, and measures noise and ladder.
    pub fn new(
        frame: &Frame,
        truth: &'a Truth,
        ladder: Option<&Ladder>,
        viewing: &Viewing,
    ) -> Result<Self, MeasureError> {
        let mut reference = Self::prepare(frame, truth, viewing, None, None)?;
        if let Some(ladder) = ladder {
            reference.add_rungs(ladder)?;
        }
        Ok(reference)
    }

    /// Prepares frame and truth with the errors that a reference of the same two and the same
    /// viewing had: see [`Reference::errors`].
    pub fn with_errors(
        frame: &Frame,
        truth: &'a Truth,
        viewing: &Viewing,
        errors: TruthErrors,
    ) -> Result<Self, MeasureError> {
        Self::prepare(frame, truth, viewing, Some(errors), None)
    }

    /// Prepares a part of the replicates of this reference's frame and truth. It measures the
    /// part's noise if its errors are not known.
    ///
    /// # Panics
    /// The truth has another support.
    pub fn part<'b>(
        &self,
        frame: &Frame,
        truth: &'b Truth,
        errors: Option<TruthErrors>,
    ) -> Result<Reference<'b>, MeasureError> {
        assert!(
            truth.support == self.truth.support,
            "a part shares the support"
        );
        Reference::prepare(frame, truth, &self.viewing, errors, Some(&self.objects))
    }

    /// Checks that frame and truth belong together; measures the truth's noise if its errors are
    /// not known. `whole` are the objects of the truth that this one is a part of.
    fn prepare(
        frame: &Frame,
        truth: &'a Truth,
        viewing: &Viewing,
        errors: Option<TruthErrors>,
        whole: Option<&[ObjectReference]>,
    ) -> Result<Self, MeasureError> {
        check_viewing(viewing)?;
        check_agreement(frame, truth)?;
        let instant = frame.picture();
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
        let seen = SeenTruth::new(&mean.color, halves, viewing);
        let measure_noise = || {
            let half = &truth.halves[0];
            let displayed = Displayed::new(&half.color, viewing);
            let maps = ErrorMaps::new(half, &displayed, [&mean.color; 2], &mean, &seen);
            let noise = Pooled::of_noise(&maps, &masks, &windows);
            TruthErrors::of_noise(noise, &maps, &mean, &masks)
        };
        let errors = errors.unwrap_or_else(measure_noise);
        let at_instant = truth.at_instant_mean();
        let frozen = at_instant.frozen(&mean.color);
        Ok(Self {
            shared: mark_shared(&instant.color, halves, &mean.color, &masks),
            windows,
            frozen: FrozenReference::new(truth, &frozen, &masks, viewing),
            origins: OriginReference::new(truth, &at_instant, &masks),
            objects: (1..truth.objects.len())
                .into_par_iter()
                .map(|id| {
                    let noise = errors.objects[id - 1];
                    let whole = whole.map(|whole| &whole[id - 1]);
                    ObjectReference::new(frame, truth, &mean, noise, &masks, id, whole)
                })
                .collect(),
            errors,
            regions: masks,
            truth,
            mean,
            seen,
            instant: instant.color,
            viewing: *viewing,
        })
    }

    /// Returns the errors of the truth itself, for [`Reference::with_errors`].
    pub fn errors(&self) -> &TruthErrors {
        &self.errors
    }

    /// Pools a picture's errors over the moving region; none if nothing moves.
    fn pool_moving(&self, picture: &Picture, halves: [&Image; 2]) -> Option<Pooled> {
        let errors = self.map_errors(picture, &self.display(picture), halves);
        Pooled::new(&errors, &self.regions, Region::Moving, &self.windows)
    }

    /// Measures one picture.
    pub fn measure(&self, output: &Picture) -> Result<Measurement, MeasureError> {
        check_picture(output, self.truth, "the output")?;
        let halves = self.halves_for(&output.color);
        self.measure_against(output, halves.each_ref(), self.frozen.halves())
    }

    /// Measures a picture: squared errors against these halves of the truth, and of the one with
    /// frozen shading.
    fn measure_against(
        &self,
        output: &Picture,
        halves: [&Image; 2],
        frozen_halves: [&Image; 2],
    ) -> Result<Measurement, MeasureError> {
        check_brightness(output, &self.viewing, "the output")?;
        let displayed = self.display(output);
        let errors = self.map_errors(output, &displayed, halves);
        let (objects, [bleed, gradient_error]) = self.measure_objects(output, &errors);
        let (frozen, frozen_squared) = self.frozen.measure(
            &output.color,
            &displayed,
            frozen_halves,
            &self.regions,
            &self.viewing,
        );
        let static_change = self.map_static_change(&output.color);
        let pooled = Pooled::over_all(&errors, &self.regions, &self.windows);
        let pooled = Region::ALL.map(|region| -> Found {
            let (own, noise) = (pooled[region as usize], self.errors.noise[region as usize]);
            own.zip(noise).ok_or(explain_empty(region))
        });
        let image = |region: Region| score_image(&pooled[region as usize]);
        let moving = &pooled[Region::Moving as usize];
        let mut measurement = Measurement {
            scores: Scores {
                moving: image(Region::Moving),
                support: image(Region::Support),
                still: image(Region::Still),
                full: image(Region::Full),
                knowable: image(Region::Knowable),
                unknowable: image(Region::Unknowable),
                frozen,
                static_contamination: self.score_static_change(&static_change),
                label_total_variation: score_labels(moving),
                objects,
                probes: ProbeScores::not_applicable("no probes were run through the filter"),
                skill: score_skill(moving, self.errors.ends.as_ref()),
                equivalent_subframes: self.score_equivalents(moving),
            },
            maps: errors.into_maps(
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
        };
        self.take_out_unknown(&mut measurement.scores);
        Ok(measurement)
    }

    /// Scores every object; maps their bleed and the errors of their gradients.
    fn measure_objects(
        &self,
        output: &Picture,
        errors: &ErrorMaps,
    ) -> (Vec<ObjectScores>, [Plane; 2]) {
        let nothing = || Plane::filled(output.color.width, output.color.height, 0.0);
        let (mut bleed, mut gradient_error) = (nothing(), nothing());
        let objects = self.objects.iter().zip(&output.coverage[1..]);
        let scores = objects.map(|(object, matte)| {
            object.add_bleed(matte, &mut bleed);
            let gradient = object.map_gradient_errors(matte);
            let pixels = gradient.iter().flat_map(|patch| patch.pixels(bleed.width));
            for (at, error) in pixels {
                gradient_error.pixels[at] += error as f32;
            }
            object.measure(matte, errors, gradient.as_ref(), &self.regions)
        });
        (scores.collect(), [bleed, gradient_error])
    }

    /// Removes the scores that an engine's truth cannot give.
    fn take_out_unknown(&self, scores: &mut Scores) {
        if self.truth.provenance.engine.is_none() {
            return;
        }
        scores.take_out_instant(NO_INSTANT);
        if self.objects.is_empty() {
            scores.take_out_mattes(NO_OBJECTS);
        }
    }

    /// Scores a filter's output for [`Probes::images`]; its weights must be those of the measured
    /// picture.
    pub fn measure_probes(&self, probes: &Probes) -> ProbeMeasurement {
        let mut measured = self.origins.measure(probes, &self.regions);
        if self.truth.provenance.engine.is_some() {
            measured.scores.gather_offset = Measured::not_applicable(NO_INSTANT);
            measured.scores.gather_spread = Measured::not_applicable(NO_INSTANT);
        }
        measured
    }

    pub(crate) fn viewing(&self) -> &Viewing {
        &self.viewing
    }

    /// Returns the colours of the truth's halves.
    pub(crate) fn half_colors(&self) -> [&Image; 2] {
        self.truth.halves.each_ref().map(|half| &half.color)
    }

    /// Returns the halves of the truth for the squared error of a picture that was made from the
    /// frame: see [`halves_for`].
    fn halves_for(&self, output: &Image) -> [Image; 2] {
        let halves = self.half_colors();
        halves_for(
            output,
            &self.instant,
            &self.shared,
            halves,
            &self.mean.color,
        )
    }

    fn display(&self, picture: &Picture) -> Displayed {
        Displayed::new(&picture.color, &self.viewing)
    }

    fn map_errors(
        &self,
        picture: &Picture,
        displayed: &Displayed,
        halves: [&Image; 2],
    ) -> ErrorMaps {
        ErrorMaps::new(picture, displayed, halves, &self.mean, &self.seen)
    }
}

/// Marks the pixels with their SSIM window in the picture.
fn mark_whole_windows(Size { width, height }: Size) -> Raster<bool> {
    Raster::from_fn(width, height, |x, y| {
        x.min(y) >= SSIM_BORDER && x + SSIM_BORDER < width && y + SSIM_BORDER < height
    })
}

fn explain_empty(region: Region) -> &'static str {
    match region {
        Region::Moving | Region::Support => "nothing moves on screen",
        Region::Still => "no pixel is still",
        Region::Full => "the picture has no pixel",
        Region::Knowable => "no moving pixel is seen whole in the frame of the instant",
        Region::Unknowable => "the frame of the instant shows all that the shutter sees",
    }
}
