//! The truth about one object's matte, ready to score any number of outputs against.

use frame::{Frame, Picture, Plane, Raster, Region, Regions, Truth};

use crate::label::average_on_object;
use crate::object::along_motion::{AlongMotion, BORDER, NO_SILHOUETTE, touches_border};
use crate::object::bleed::measure_bleed;
use crate::object::gradient::{gradient_error, gradient_magnitude};
use crate::object::mass::{Mass, measure_mass};
use crate::object::misplacement::{Misplacement, measure_misplacement};
use crate::object::mover::{Directions, Mover};
use crate::object::patch::Patch;
use crate::object::row_mass::RowMass;
use crate::object::sides::{Side, find_sides};
use crate::picture::error_maps::ErrorMaps;
use crate::{Measured, ObjectMetric, ObjectScores};

/// One object of the truth, with the scores of the truth's own noise on it.
pub struct ObjectReference {
    name: String,
    truth: Plane,
    /// Pixels where the object is seen throughout the shutter.
    core: Raster<bool>,
    /// Its motion, or the reason why it has no matte scores.
    mover: Result<Moving, &'static str>,
    /// Mass scores of the truth's first half.
    mass_noise: Option<Mass>,
    /// Mean errors of the first half's labels and colour on the object.
    label_noise: Option<f64>,
    flip_noise: Option<f64>,
    /// True if the object is seen at the picture's border, at the instant or while the shutter is
    /// open.
    is_at_border: bool,
}

/// Facts about an object that moves.
struct Moving {
    mover: Mover,
    sides: Option<Raster<Side>>,
    /// Bleed of the truth's first half: lateral, leading and trailing.
    bleed_noise: Option<[f64; 3]>,
    rows: Result<AlongMotion, String>,
    /// Gradient magnitude of the true matte; none if it is zero.
    gradient: Option<Patch>,
    /// Mean error of the first half's gradient where anything moves.
    gradient_noise: Option<f64>,
}

impl ObjectReference {
    /// Prepares object `id` of a truth and its frame. `noise` are the errors of the first half.
    pub fn new(
        (frame, truth): (&Frame, &Truth),
        (mean, noise): (&Picture, &ErrorMaps),
        regions: &Regions,
        id: usize,
    ) -> Self {
        let matte = mean.coverage[id].clone();
        let half = &truth.halves[0].coverage[id];
        let instant = &frame.coverage[id];
        let support = &truth.support.seen[id];
        let core = truth.support.throughout(id);
        let seen = support.map(|seen| f32::from(*seen));
        let is_at_border = touches_border(&seen) || touches_border(instant);
        let moving = |(mover, directions): (Mover, Directions)| {
            let gradient = gradient_magnitude(&matte);
            let sides = find_sides(support, &directions);
            drop(directions);
            Moving {
                bleed_noise: (sides.as_ref())
                    .and_then(|sides| measure_bleed(half, sides, &mover.silhouette)),
                sides,
                rows: AlongMotion::new(&mover, is_at_border, instant, &matte, half),
                gradient_noise: average_patch(
                    gradient_error(gradient_magnitude(half).as_ref(), gradient.as_ref()).as_ref(),
                    regions,
                ),
                gradient,
                mover,
            }
        };
        Self {
            name: truth.objects[id].clone(),
            mover: Mover::new(frame, id as u32).map(moving),
            mass_noise: measure_mass(half, &matte, &core),
            label_noise: average_on_object(&noise.label, &matte, &regions.moving),
            flip_noise: average_on_object(&noise.flip, &matte, &regions.moving),
            core,
            is_at_border,
            truth: matte,
        }
    }

    /// Scores an output's matte, with the output's `errors`. `gradient` is
    /// [`ObjectReference::map_gradient_errors`] of the matte.
    pub fn measure(
        &self,
        matte: &Plane,
        errors: &ErrorMaps,
        gradient: Option<&Patch>,
        regions: &Regions,
    ) -> ObjectScores {
        let variation = average_on_object(&errors.label, &self.truth, &regions.moving);
        let flip = average_on_object(&errors.flip, &self.truth, &regions.moving);
        let [bleed_lateral, bleed_leading, bleed_trailing] = self.score_bleed(matte);
        let [
            lateral_growth,
            row_gain,
            row_loss,
            misplacement,
            centroid,
            extent,
            tv_excess,
        ] = self.score_rows(matte);
        let [hole, deficit, energy] = self.score_mass(matte);
        let moving = self.mover.as_ref();
        ObjectScores {
            object: self.name.clone(),
            moves: moving.is_ok(),
            displacement: moving.map_or([0.0; 2], |moving| moving.mover.displacement),
            bleed_lateral,
            bleed_leading,
            bleed_trailing,
            lateral_growth,
            row_gain,
            row_loss,
            misplacement,
            centroid,
            extent,
            tv_excess,
            hole,
            deficit,
            energy,
            label_total_variation: score(
                ObjectMetric::LabelTotalVariation,
                variation,
                self.label_noise,
                "is not seen in the moving region",
            ),
            flip: score(
                ObjectMetric::Flip,
                flip,
                self.flip_noise,
                "is not seen in the moving region",
            ),
            gradient_error: self.score_gradient(gradient, regions),
        }
    }

    /// Maps the squared difference of the gradient magnitudes of matte and truth; `None` if it is
    /// zero, and for an object that does not move.
    pub fn map_gradient_errors(&self, matte: &Plane) -> Option<Patch> {
        let moving = self.mover.as_ref().ok()?;
        gradient_error(gradient_magnitude(matte).as_ref(), moving.gradient.as_ref())
    }

    fn score_gradient(&self, errors: Option<&Patch>, regions: &Regions) -> Measured {
        match self.moving() {
            Ok(moving) => score(
                ObjectMetric::GradientError,
                average_patch(errors, regions),
                moving.gradient_noise,
                "is not seen in the moving region",
            ),
            Err(reason) => Measured::not_applicable(reason),
        }
    }

    /// Adds the object's matte outside its support; nothing for an object that does not move.
    pub fn add_bleed(&self, matte: &Plane, bleed: &mut Plane) {
        let Ok(Moving {
            sides: Some(sides), ..
        }) = &self.mover
        else {
            return;
        };
        let pixels = matte.pixels.iter().zip(&sides.pixels);
        for (bleed, (matte, side)) in bleed.pixels.iter_mut().zip(pixels) {
            if *side != Side::Inside {
                *bleed += matte;
            }
        }
    }

    pub(crate) fn score_bleed(&self, matte: &Plane) -> [Measured; 3] {
        let moving = match self.moving() {
            Ok(moving) => moving,
            Err(reason) => return [(); 3].map(|()| Measured::not_applicable(reason)),
        };
        let found = moving
            .sides
            .as_ref()
            .and_then(|sides| measure_bleed(matte, sides, &moving.mover.silhouette));
        let noise = moving.bleed_noise;
        let pick = |metric, side: usize| {
            let [found, noise] = [found, noise].map(|bleed| Some(bleed?[side]));
            score(metric, found, noise, NO_SILHOUETTE)
        };
        [
            pick(ObjectMetric::BleedLateral, 0),
            pick(ObjectMetric::BleedLeading, 1),
            pick(ObjectMetric::BleedTrailing, 2),
        ]
    }

    /// Scores growth, gain, loss, misplacement, centroid, extent and excess of total variation.
    fn score_rows(&self, matte: &Plane) -> [Measured; 7] {
        let (rows, mover) = match self.along_motion() {
            Ok(found) => found,
            Err(reason) => return [(); 7].map(|()| Measured::not_applicable(&reason)),
        };
        let grid = rows.rows.spread(matte);
        let [growth, gain, loss] = match &rows.mass_floor {
            Ok(floor) => {
                let length = mover.silhouette.lateral;
                let found = RowMass::new(&grid, &rows.truth, &rows.instant, length);
                [
                    Measured::score(found.growth, floor.growth),
                    Measured::score(found.gain, floor.gain),
                    Measured::score(found.loss, floor.loss),
                ]
            }
            Err(reason) => [(); 3].map(|()| Measured::not_applicable(reason)),
        };
        let found = measure_misplacement(&grid, &rows.truth);
        let noise = rows.misplacement_noise;
        let pick = |metric, part: fn(Misplacement) -> Option<f64>| {
            let reason = match found {
                None => "has no mass where the truth has some",
                Some(_) => "has negative mass, which leaves it no length",
            };
            let noise = noise.and_then(part);
            score(metric, found.and_then(part), noise, reason)
        };
        [
            growth,
            gain,
            loss,
            pick(ObjectMetric::Misplacement, |found| Some(found.distance)),
            pick(ObjectMetric::Centroid, |found| Some(found.centroid)),
            pick(ObjectMetric::Extent, |found| found.extent),
            Measured::score(
                grid.total_variation() / rows.truth.total_variation() - 1.0,
                ObjectMetric::TvExcess
                    .row()
                    .ideal
                    .floor(rows.variation_noise),
            ),
        ]
    }

    fn score_mass(&self, matte: &Plane) -> [Measured; 3] {
        if let Err(reason) = self.moving() {
            return [(); 3].map(|()| Measured::not_applicable(reason));
        }
        let found = measure_mass(matte, &self.truth, &self.core);
        let pick = |metric, part: fn(Mass) -> Option<f64>, reason| {
            let [found, noise] = [found, self.mass_noise].map(|mass| mass.and_then(part));
            score(metric, found, noise, reason)
        };
        let unseen = "is not seen while the shutter is open";
        let uncovered = "covers no pixel throughout the shutter";
        [
            pick(ObjectMetric::Hole, |mass| mass.hole, uncovered),
            pick(ObjectMetric::Deficit, |mass| Some(mass.deficit), unseen),
            if self.is_at_border {
                Measured::not_applicable(BORDER)
            } else {
                pick(ObjectMetric::Energy, |mass| Some(mass.energy), unseen)
            },
        ]
    }

    fn moving(&self) -> Result<&Moving, &'static str> {
        self.mover.as_ref().map_err(|reason| *reason)
    }

    fn along_motion(&self) -> Result<(&AlongMotion, &Mover), String> {
        let moving = self.moving()?;
        let rows = moving.rows.as_ref().map_err(String::clone)?;
        Ok((rows, &moving.mover))
    }
}

/// Averages a map where anything moves; `None` if nothing does.
fn average_patch(patch: Option<&Patch>, regions: &Regions) -> Option<f64> {
    let moving = &regions.moving;
    let pixels = patch
        .into_iter()
        .flat_map(|patch| patch.pixels(moving.width));
    let inside = pixels.filter(|(at, _)| moving.pixels[*at]);
    let sum: f64 = inside.map(|(_, value)| value).sum();
    let count = regions.indices(Region::Moving).count();
    (count > 0).then(|| sum / count as f64)
}

/// Makes a score of a value and its noise, with the metric's floor, or gives the reason for their
/// absence.
fn score(metric: ObjectMetric, value: Option<f64>, noise: Option<f64>, reason: &str) -> Measured {
    let floor = noise.map(|noise| metric.row().ideal.floor(noise));
    Measured::of(value, floor, reason)
}
