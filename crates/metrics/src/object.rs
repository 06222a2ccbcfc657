//! The truth about one object's matte, ready to score any number of outputs against.

use frame::{Frame, Picture, Plane, Raster, Truth};

use crate::bleed::{Bleed, Side, bleed, sides};
use crate::label::on_object;
use crate::lateral::{Lateral, lateral};
use crate::mass::{Mass, mass};
use crate::misplacement::{Misplacement, misplacement};
use crate::mover::{Mover, Stillness};
use crate::rows::{Grid, Rows};
use crate::{Measured, ObjectMetric, ObjectScores};

/// Rows along the motion may differ between instant and shutter by this many pixels of silhouette, growth and shrink
/// together. Above it, growth would measure what hides the object, not what a filter did.
const LARGEST_ROW_CHANGE: f64 = 0.25;

/// One object, and what the truth's own noise scores on it.
pub struct ObjectReference {
    name: String,
    truth: Plane,
    mover: Result<Moving, Stillness>,
    /// Mass scores of the truth's first half.
    mass_noise: Option<Mass>,
    /// Whether the matte of truth or instant reaches the picture's border.
    touches_border: bool,
}

/// What only an object that moves has.
struct Moving {
    mover: Mover,
    sides: Option<Raster<Side>>,
    /// Bleed of one half out of the other's support.
    bleed_noise: Option<Bleed>,
    rows: Result<AlongMotion, String>,
}

/// What only an object has that translates within the picture.
struct AlongMotion {
    rows: Rows,
    truth: Grid,
    misplacement_noise: Option<Misplacement>,
    /// Noise plus the difference between the instant's rows and the shutter's; a reason where that is too large.
    lateral_floor: Result<Lateral, String>,
}

impl ObjectReference {
    /// Object `id` of a truth and its frame.
    pub fn new(frame: &Frame, truth: &Truth, mean: &Picture, id: usize) -> Self {
        let matte = mean.coverage[id].clone();
        let half = &truth.halves[0].coverage[id];
        let instant = &frame.coverage[id];
        let touches_border = touches_border(&matte) || touches_border(instant);
        let moving = |mover: Mover| {
            let other = &truth.halves[1].coverage[id];
            let bleed_noise = sides(other, &mover.directions)
                .and_then(|sides| bleed(half, &sides, &mover.silhouette));
            Moving {
                sides: sides(&matte, &mover.directions),
                bleed_noise,
                rows: AlongMotion::new(&mover, touches_border, instant, &matte, half),
                mover,
            }
        };
        Self {
            name: truth.objects[id].clone(),
            mover: Mover::new(frame, id as u32).map(moving),
            mass_noise: mass(half, &matte),
            touches_border,
            truth: matte,
        }
    }

    /// Scores an output's matte. `variation` and `noise` are the label total variations of the output and of the truth's
    /// first half; `region` is where they count.
    pub fn measure(
        &self,
        matte: &Plane,
        variation: &Raster<f64>,
        noise: &Raster<f64>,
        region: &Raster<bool>,
    ) -> ObjectScores {
        let [bleed_lateral, bleed_leading, bleed_trailing] = self.bleed_scores(matte);
        let [lateral_growth, lateral_shrink] = self.lateral_scores(matte);
        let [misplacement, centroid, extent] = self.misplacement_scores(matte);
        let [hole, deficit, energy] = self.mass_scores(matte);
        let moving = self.mover.as_ref();
        ObjectScores {
            object: self.name.clone(),
            moves: moving.is_ok(),
            displacement: moving.map_or([0.0; 2], |moving| moving.mover.displacement),
            bleed_lateral,
            bleed_leading,
            bleed_trailing,
            lateral_growth,
            lateral_shrink,
            misplacement,
            centroid,
            extent,
            hole,
            deficit,
            energy,
            label_total_variation: score(
                ObjectMetric::LabelTotalVariation,
                on_object(variation, &self.truth, region),
                on_object(noise, &self.truth, region),
                "is not seen in the moving region",
            ),
        }
    }

    /// The object's matte outside its true support, zero elsewhere and for what does not move.
    pub fn bleed_map(&self, matte: &Plane) -> Plane {
        match &self.mover {
            Ok(Moving {
                sides: Some(sides), ..
            }) => matte.zip(sides, |matte, side| match side {
                Side::Inside => 0.0,
                Side::Lateral | Side::Leading | Side::Trailing => *matte,
            }),
            _ => matte.map(|_| 0.0),
        }
    }

    fn bleed_scores(&self, matte: &Plane) -> [Measured; 3] {
        let moving = match self.moving() {
            Ok(moving) => moving,
            Err(reason) => return [(); 3].map(|()| Measured::not_applicable(&reason)),
        };
        let found = moving
            .sides
            .as_ref()
            .and_then(|sides| bleed(matte, sides, &moving.mover.silhouette));
        let noise = moving.bleed_noise;
        let pick = |metric, part: fn(Bleed) -> f64| {
            let reason = "shows no silhouette inside the picture";
            score(metric, found.map(part), noise.map(part), reason)
        };
        [
            pick(ObjectMetric::BleedLateral, |bleed| bleed.lateral),
            pick(ObjectMetric::BleedLeading, |bleed| bleed.leading),
            pick(ObjectMetric::BleedTrailing, |bleed| bleed.trailing),
        ]
    }

    fn lateral_scores(&self, matte: &Plane) -> [Measured; 2] {
        let rows = self.along_motion();
        let floor = rows
            .as_ref()
            .map_err(String::clone)
            .and_then(|(rows, _)| rows.lateral_floor.clone());
        match (rows, floor) {
            (Ok((rows, mover)), Ok(floor)) => {
                let found = lateral(
                    &rows.rows.spread(matte),
                    &rows.truth,
                    mover.silhouette.lateral,
                );
                [
                    Measured::score(found.growth, floor.growth),
                    Measured::score(found.shrink, floor.shrink),
                ]
            }
            (_, Err(reason)) | (Err(reason), _) => {
                [(); 2].map(|()| Measured::not_applicable(&reason))
            }
        }
    }

    fn misplacement_scores(&self, matte: &Plane) -> [Measured; 3] {
        let rows = match self.along_motion() {
            Ok((rows, _)) => rows,
            Err(reason) => return [(); 3].map(|()| Measured::not_applicable(&reason)),
        };
        let found = misplacement(&rows.rows.spread(matte), &rows.truth);
        let noise = rows.misplacement_noise;
        let pick = |metric, part: fn(Misplacement) -> f64| {
            let reason = "has no mass where the truth has some";
            score(metric, found.map(part), noise.map(part), reason)
        };
        [
            pick(ObjectMetric::Misplacement, |found| found.distance),
            pick(ObjectMetric::Centroid, |found| found.centroid),
            pick(ObjectMetric::Extent, |found| found.extent),
        ]
    }

    fn mass_scores(&self, matte: &Plane) -> [Measured; 3] {
        if let Err(reason) = self.moving() {
            return [(); 3].map(|()| Measured::not_applicable(&reason));
        }
        let (found, noise) = (mass(matte, &self.truth), self.mass_noise);
        let unseen = "is not seen while the shutter is open";
        let energy = if self.touches_border {
            Measured::not_applicable(BORDER)
        } else {
            score(
                ObjectMetric::Energy,
                found.map(|mass| mass.energy),
                noise.map(|mass| mass.energy),
                unseen,
            )
        };
        [
            score(
                ObjectMetric::Hole,
                found.and_then(|mass| mass.hole),
                noise.and_then(|mass| mass.hole),
                "covers no pixel throughout the shutter",
            ),
            score(
                ObjectMetric::Deficit,
                found.map(|mass| mass.deficit),
                noise.map(|mass| mass.deficit),
                unseen,
            ),
            energy,
        ]
    }

    fn moving(&self) -> Result<&Moving, String> {
        self.mover.as_ref().map_err(|stillness| match stillness {
            Stillness::Invisible => "is not visible at the instant".to_owned(),
            Stillness::Still => "does not move".to_owned(),
        })
    }

    fn along_motion(&self) -> Result<(&AlongMotion, &Mover), String> {
        let moving = self.moving()?;
        let rows = moving.rows.as_ref().map_err(String::clone)?;
        Ok((rows, &moving.mover))
    }
}

impl AlongMotion {
    fn new(
        mover: &Mover,
        touches_border: bool,
        instant: &Plane,
        truth: &Plane,
        half: &Plane,
    ) -> Result<Self, String> {
        let along = mover.translation()?;
        if touches_border {
            return Err(BORDER.to_owned());
        }
        let rows = Rows::new(along, truth.width, truth.height);
        let [instant, truth, half] = [instant, truth, half].map(|matte| rows.spread(matte));
        let length = mover.silhouette.lateral;
        let change = lateral(&instant, &truth, length);
        let noise = lateral(&half, &truth, length);
        let changed = change.growth + change.shrink;
        let lateral_floor = if changed <= LARGEST_ROW_CHANGE {
            Ok(Lateral {
                growth: noise.growth + change.growth,
                shrink: noise.shrink + change.shrink,
            })
        } else {
            Err(format!(
                "rows do not keep their mass: occlusion or a change of shape alters the silhouette by {changed:.2} px \
                 between instant and shutter, {LARGEST_ROW_CHANGE} px at most allow to tell growth"
            ))
        };
        Ok(Self {
            misplacement_noise: misplacement(&half, &truth),
            lateral_floor,
            rows,
            truth,
        })
    }
}

const BORDER: &str = "touches the picture's border, where part of its smear is cut off";

fn touches_border(matte: &Plane) -> bool {
    let (right, bottom) = (matte.width - 1, matte.height - 1);
    let columns = (0..matte.width).flat_map(|x| [(x, 0), (x, bottom)]);
    let rows = (0..matte.height).flat_map(|y| [(0, y), (right, y)]);
    columns.chain(rows).any(|(x, y)| *matte.at(x, y) > 0.0)
}

/// A value and its noise as a score with the metric's floor, or the reason for their absence.
fn score(metric: ObjectMetric, value: Option<f64>, noise: Option<f64>, reason: &str) -> Measured {
    match (value, noise) {
        (Some(value), Some(noise)) => Measured::score(value, metric.ideal().floor(noise)),
        _ => Measured::not_applicable(reason),
    }
}
