//! A scene as tuning needs it: loaded once, measured against hundreds of times.

use std::path::Path;

use frame::{Alignment, Frame, Image, Plane, Raster, Region, Truth};
use metrics::{ImageMetric, Metric, ObjectMetric, Reference, Viewing, flip_ldr};
use serde::{Deserialize, Serialize};
use tracer::{Family, Scene};

use crate::judge::bounds::{Bounds, SceneBounds};
use crate::measure::references::viewing;
use crate::render::frames::render_frame;
use crate::render::truths::render_truth;
use crate::{Error, Monitor, RenderSettings};

/// Frame and truth of one scene.
pub struct Shot {
    /// The scene's name, with its variant.
    pub name: String,
    /// The scene's family.
    pub family: Family,
    /// What the filter is given.
    pub frame: Frame,
    /// What it is measured against.
    pub truth: Truth,
    /// What it is held to.
    pub bounds: SceneBounds,
    viewing: Viewing,
}

/// What one candidate scores on one scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneScore {
    /// `flip_moving`.
    pub flip: f64,
    /// `bleed_lateral`, in pixels; none where it was not asked for or does not apply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bleed: Option<f64>,
}

impl Shot {
    /// Reads frame and truth from `out`, or renders and keeps them there.
    pub fn new(
        (scene, bounds): (&Scene, SceneBounds),
        alignment: Alignment,
        render: &RenderSettings,
        out: &Path,
        monitor: Monitor,
    ) -> Result<Self, Error> {
        Ok(Self {
            name: scene.name.clone(),
            family: scene.family,
            frame: render_frame(scene, render, out, monitor)?,
            truth: render_truth(scene, render, alignment, out, monitor)?,
            viewing: viewing(scene),
            bounds,
        })
    }
}

/// A shot with all that does not depend on the picture.
pub struct Target<'a> {
    /// Frame, truth, name.
    pub shot: &'a Shot,
    /// The bounds of the filter and preset that are tuned.
    pub bounds: Bounds,
    reference: Reference<'a>,
    mean: Image,
    /// Where anything moves.
    moving: Raster<bool>,
}

impl<'a> Target<'a> {
    /// Refuses a scene where nothing moves: it has no error to make smaller.
    pub fn new(shot: &'a Shot, filter: &str, preset: &str) -> Result<Self, Error> {
        let frame = shot.frame.cropped();
        let reference = Reference::new(&frame, &shot.truth, None, &shot.viewing)?;
        let moving = reference.regions.moving.clone();
        if !moving.pixels.contains(&true) {
            return Err(Error::Usage(format!(
                "scene {}: nothing moves on screen, so that there is nothing to tune; leave it out of --scenes",
                shot.name
            )));
        }
        Ok(Self {
            shot,
            bounds: shot.bounds.of(filter, preset),
            mean: shot.truth.mean().color,
            moving,
            reference,
        })
    }

    /// Scores a picture, and its mattes where there are any.
    pub fn score(&self, color: &Image, mattes: Option<&[Plane]>) -> SceneScore {
        SceneScore {
            flip: self.flip(color),
            bleed: mattes.and_then(|mattes| self.reference.measure_bleed_lateral(mattes)),
        }
    }

    /// `flip_moving` and nothing else.
    fn flip(&self, color: &Image) -> f64 {
        let errors = flip_ldr(&self.mean, color, &self.shot.viewing);
        let inside = errors.pixels.iter().zip(&self.moving.pixels);
        let inside = inside.filter_map(|(error, moves)| moves.then_some(f64::from(*error)));
        let (sum, count) = inside.fold((0.0, 0.0), |(sum, count), it| (sum + it, count + 1.0));
        sum / count
    }

    /// By how much the scores break bounds, in parts of the limits; 0 where they keep all of them. A bound that the start
    /// breaks is held at what the start has.
    pub fn excess(&self, score: &SceneScore, start: &SceneScore) -> f64 {
        let flip = Metric::Image(ImageMetric::Flip, Region::Moving);
        let bleed = Metric::Object(ObjectMetric::BleedLateral);
        let measured = [
            (flip, Some(score.flip), Some(start.flip)),
            (bleed, score.bleed, start.bleed),
        ];
        let excess = measured.into_iter().filter_map(|(metric, value, start)| {
            let bound = self.bounds.get(&metric.name())?;
            // A limit for another picture size says nothing about this one.
            (bound.size.is_none_or(|size| size == self.shot.truth.size())).then_some(())?;
            let limit = bound.limit.max(start?);
            Some((value? / limit - 1.0).max(0.0))
        });
        excess.filter(|it| it.is_finite()).sum()
    }
}
