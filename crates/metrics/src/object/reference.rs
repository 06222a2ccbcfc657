//! The truth about one object's matte, ready to score any number of outputs against.

use std::sync::Arc;

use frame::{Frame, Picture, Plane, Raster, Region, Regions, Truth};

use crate::label::average_on_object;
use crate::object::along_motion::{AlongMotion, BORDER, NO_SILHOUETTE, touches_border};
use crate::object::bleed::{Bleed, measure_bleed};
use crate::object::gradient::{gradient_error, gradient_magnitude};
use crate::object::mass::{Mass, measure_mass};
use crate::object::misplacement::{Misplacement, measure_misplacement};
use crate::object::mover::{Directions, Mover};
use crate::object::noise::ObjectNoise;
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
    /// Errors of the truth's first half on the object.
    noise: ObjectNoise,
    /// True if the object is seen at the picture's border, at the instant or while the shutter is
    /// open.
    is_at_border: bool,
}

/// Facts about an object that moves.
struct Moving {
    mover: Mover,
    sides: Option<Arc<Raster<Side>>>,
    /// Bleed of the truth's first half.
    bleed_noise: Option<Bleed>,
    rows: Result<AlongMotion, String>,
    /// Gradient magnitude of the true matte; none if it is zero.
    gradient: Option<Patch>,
    /// Mean error of the first half's gradient where anything moves.
    gradient_noise: Option<f64>,
}

/// Scores of mass outside the support.
pub(crate) struct BleedScores {
    pub lateral: Measured,
    pub leading: Measured,
    pub trailing: Measured,
}

/// Scores of rows along the motion.
struct RowScores {
    growth: Measured,
    gain: Measured,
    loss: Measured,
    misplacement: Measured,
    centroid: Measured,
    extent: Measured,
    tv_excess: Measured,
}

/// Scores of mass inside the support.
struct MassScores {
    hole: Measured,
    deficit: Measured,
    energy: Measured,
}

impl ObjectReference {
    /// Prepares object `id` of a truth and its frame. `noise` are the errors of the first half.
    /// `whole` is the same object of a truth that this one is a part of.
    pub fn new(
        frame: &Frame,
        truth: &Truth,
        mean: &Picture,
        noise: ObjectNoise,
        regions: &Regions,
        id: usize,
        whole: Option<&Self>,
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
            let sides = match whole.map(Self::moving) {
                Some(Ok(whole)) => whole.sides.clone(),
                _ => find_sides(support, &directions).map(Arc::new),
            };
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
            noise,
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
        let bleed = self.score_bleed(matte);
        let rows = self.score_rows(matte);
        let mass = self.score_mass(matte);
        let moving = self.mover.as_ref();
        ObjectScores {
            object: self.name.clone(),
            moves: moving.is_ok(),
            displacement: moving.map_or([0.0; 2], |moving| moving.mover.displacement),
            bleed_lateral: bleed.lateral,
            bleed_leading: bleed.leading,
            bleed_trailing: bleed.trailing,
            lateral_growth: rows.growth,
            row_gain: rows.gain,
            row_loss: rows.loss,
            misplacement: rows.misplacement,
            centroid: rows.centroid,
            extent: rows.extent,
            tv_excess: rows.tv_excess,
            hole: mass.hole,
            deficit: mass.deficit,
            energy: mass.energy,
            label_total_variation: score(
                ObjectMetric::LabelTotalVariation,
                variation,
                self.noise.label,
                "is not seen in the moving region",
            ),
            flip: score(
                ObjectMetric::Flip,
                flip,
                self.noise.flip,
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

    pub(crate) fn score_bleed(&self, matte: &Plane) -> BleedScores {
        let moving = match self.moving() {
            Ok(moving) => moving,
            Err(reason) => {
                let none = || Measured::not_applicable(reason);
                return BleedScores {
                    lateral: none(),
                    leading: none(),
                    trailing: none(),
                };
            }
        };
        let bleed = moving
            .sides
            .as_ref()
            .and_then(|sides| measure_bleed(matte, sides, &moving.mover.silhouette));
        let noise = moving.bleed_noise;
        let pick = |metric, side: fn(Bleed) -> f64| {
            score(metric, bleed.map(side), noise.map(side), NO_SILHOUETTE)
        };
        BleedScores {
            lateral: pick(ObjectMetric::BleedLateral, |bleed| bleed.lateral),
            leading: pick(ObjectMetric::BleedLeading, |bleed| bleed.leading),
            trailing: pick(ObjectMetric::BleedTrailing, |bleed| bleed.trailing),
        }
    }

    fn score_rows(&self, matte: &Plane) -> RowScores {
        let (rows, mover) = match self.along_motion() {
            Ok(along) => along,
            Err(reason) => return RowScores::not_applicable(&reason),
        };
        let grid = rows.rows.spread(matte);
        let length = mover.silhouette.lateral;
        let mass = (rows.mass_floor.as_ref()).map(|floor| {
            (
                RowMass::new(&grid, &rows.truth, &rows.instant, length),
                floor,
            )
        });
        let score_part = |part: fn(&RowMass) -> f64| match &mass {
            Ok((mass, floor)) => Measured::score(part(mass), part(floor)),
            Err(reason) => Measured::not_applicable(reason.as_str()),
        };
        let misplacement = measure_misplacement(&grid, &rows.truth);
        let noise = rows.misplacement_noise;
        let pick = |metric, part: fn(Misplacement) -> Option<f64>| {
            let reason = match misplacement {
                None => "has no mass where the truth has some",
                Some(_) => "has negative mass, which leaves it no length",
            };
            let noise = noise.and_then(part);
            score(metric, misplacement.and_then(part), noise, reason)
        };
        RowScores {
            growth: score_part(|mass| mass.growth),
            gain: score_part(|mass| mass.gain),
            loss: score_part(|mass| mass.loss),
            misplacement: pick(ObjectMetric::Misplacement, |place| Some(place.distance)),
            centroid: pick(ObjectMetric::Centroid, |place| Some(place.centroid)),
            extent: pick(ObjectMetric::Extent, |place| place.extent),
            tv_excess: Measured::score(
                grid.total_variation() / rows.truth.total_variation() - 1.0,
                ObjectMetric::TvExcess
                    .row()
                    .ideal
                    .floor(rows.variation_noise),
            ),
        }
    }

    fn score_mass(&self, matte: &Plane) -> MassScores {
        if let Err(reason) = self.moving() {
            let none = || Measured::not_applicable(reason);
            return MassScores {
                hole: none(),
                deficit: none(),
                energy: none(),
            };
        }
        let mass = measure_mass(matte, &self.truth, &self.core);
        let pick = |metric, part: fn(Mass) -> Option<f64>, reason| {
            let [value, noise] = [mass, self.mass_noise].map(|mass| mass.and_then(part));
            score(metric, value, noise, reason)
        };
        let unseen = "is not seen while the shutter is open";
        let uncovered = "covers no pixel throughout the shutter";
        MassScores {
            hole: pick(ObjectMetric::Hole, |mass| mass.hole, uncovered),
            deficit: pick(ObjectMetric::Deficit, |mass| Some(mass.deficit), unseen),
            energy: if self.is_at_border {
                Measured::not_applicable(BORDER)
            } else {
                pick(ObjectMetric::Energy, |mass| Some(mass.energy), unseen)
            },
        }
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

impl RowScores {
    fn not_applicable(reason: &str) -> Self {
        let none = || Measured::not_applicable(reason);
        Self {
            growth: none(),
            gain: none(),
            loss: none(),
            misplacement: none(),
            centroid: none(),
            extent: none(),
            tv_excess: none(),
        }
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
