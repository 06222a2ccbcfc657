//! Scenes that candidates are scored on.

use std::collections::BTreeMap;
use std::path::Path;

use filters::Filter;
use frame::{Image, Truth};
use judge::{BoundedScene, Bounds, SceneBounds};
use measure::{Error, FilterFrame, Monitor, Rendering};
use metrics::{Metric, ObjectMetric, Reference, Viewing, flip_ldr};
use serde::{Deserialize, Serialize};
use tracer::RenderSettings;

use crate::candidate::Blurred;

/// A scene, rendered once and used for hundreds of measurements.
pub struct RenderedScene {
    /// The scene's name, with its variant.
    pub name: String,
    /// Input of the filter.
    pub frame: FilterFrame,
    /// Reference to compare pictures with.
    pub truth: Truth,
    /// The scene's bounds for pictures of this size, for every filter.
    pub bounds: SceneBounds,
    /// Viewing display for errors.
    pub viewing: Viewing,
}

/// Reads frames and truths of scenes for a filter from `out`, or renders and keeps them there.
pub fn render_scenes(
    scenes: &[BoundedScene],
    filter: &Filter,
    render: &RenderSettings,
    out: &Path,
    monitor: Monitor,
) -> Result<Vec<RenderedScene>, Error> {
    let render_scene = |BoundedScene { scene, bounds }: &BoundedScene| {
        let rendering = Rendering {
            scene: scene.into(),
            settings: *render,
            out,
            monitor,
        };
        Ok(RenderedScene {
            name: scene.id.to_string(),
            frame: rendering.frame_for(filter)?,
            truth: rendering.truth(filter.alignment)?,
            viewing: scene.display.into(),
            bounds: bounds.clone().at(render.size()),
        })
    };
    scenes.iter().map(render_scene).collect()
}

/// Scores of one candidate on one scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneScore {
    /// `flip_moving`.
    pub flip: f64,
    /// `bleed_lateral`, in pixels; none if it was not requested or does not apply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bleed: Option<f64>,
}

/// Scores of one candidate by scene.
pub type SceneScores = BTreeMap<String, SceneScore>;

/// A rendered scene with everything that does not depend on the picture.
pub struct Target<'a> {
    /// Frame, truth and name.
    pub scene: &'a RenderedScene,
    /// Bounds of the tuned filter and preset.
    pub bounds: Bounds,
    reference: Reference<'a>,
    mean: Image,
}

impl<'a> Target<'a> {
    /// Prepares a scene for scoring. Refuses a scene without motion: it has no error to reduce.
    pub fn new(scene: &'a RenderedScene, filter: &str, preset: &str) -> Result<Self, Error> {
        let frame = scene.frame.cropped();
        let reference = Reference::new(&frame, &scene.truth, None, &scene.viewing)?;
        if !reference.regions.moving.pixels.contains(&true) {
            return Err(Error::Refused(format!(
                "scene {}: nothing moves on screen, so there is nothing to tune; leave the scene out",
                scene.name
            )));
        }
        Ok(Self {
            scene,
            bounds: scene.bounds.of(filter, preset),
            mean: scene.truth.mean().color,
            reference,
        })
    }

    /// Scores a picture by `flip_moving` alone, and its mattes, if any, by their bleed.
    pub fn score(&self, Blurred { color, mattes }: &Blurred) -> SceneScore {
        let errors = flip_ldr(&self.mean, color, &self.scene.viewing);
        let moving = &self.reference.regions.moving.pixels;
        let inside = errors.pixels.iter().zip(moving);
        let inside = inside.filter_map(|(error, moves)| moves.then_some(f64::from(*error)));
        let (sum, count) =
            inside.fold((0.0, 0.0), |(sum, count), error| (sum + error, count + 1.0));
        SceneScore {
            flip: sum / count,
            bleed: (mattes.as_ref())
                .and_then(|mattes| self.reference.measure_bleed_lateral(mattes)),
        }
    }

    /// Returns by how much the scores exceed their limits, as a fraction of the limits; 0 if they
    /// keep all of them. A bound that the start breaks is relaxed to the start's score.
    pub fn excess(&self, score: &SceneScore, start: &SceneScore) -> f64 {
        let bleed = Metric::Object(ObjectMetric::BleedLateral);
        let measured = [
            (Metric::FLIP, Some(score.flip), Some(start.flip)),
            (bleed, score.bleed, start.bleed),
        ];
        let excess = measured.into_iter().filter_map(|(metric, value, start)| {
            let bound = self.bounds.get(&metric)?;
            let limit = bound.limit.max(start?);
            Some((value? / limit - 1.0).max(0.0))
        });
        excess.filter(|value| value.is_finite()).sum()
    }
}
