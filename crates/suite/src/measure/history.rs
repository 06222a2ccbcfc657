//! The frame before, for filters that read it.

use frame::Frame;
use tracer::Scene;

use super::plan::RunPlan;
use super::run_scene::RunScene;
use crate::filter::choice::FilterChoice;
use crate::filter::input_format::InputFormat;
use crate::render::frames::render_frame;
use crate::{Error, Monitor};

/// A frame in the forms in which filters get it.
pub(super) fn store_frame(
    inputs: &[InputFormat],
    frame: &Frame,
    scene: Option<&Scene>,
    monitor: Monitor,
) -> Result<Vec<(InputFormat, Frame)>, Error> {
    let stored = inputs.iter();
    stored
        .map(|format| Ok((*format, format.apply(frame, scene, monitor)?)))
        .collect()
}

/// Reads the frame before that of a later frame, in the forms in which filters get it. Empty for a first frame, and where no filter
/// has history.
pub(super) fn frames_before(
    plan: &RunPlan,
    filters: &[FilterChoice],
    scene: RunScene,
    inputs: &[InputFormat],
) -> Result<Vec<(InputFormat, Frame)>, Error> {
    let has_history = filters
        .iter()
        .any(|choice| !choice.filter.history.is_empty());
    let Some(later) = scene
        .traced()
        .filter(|scene| has_history && scene.id.frame > 0)
    else {
        return Ok(Vec::new());
    };
    let is_own = |scene: &&Scene| scene.id == later.id.at_frame(0);
    let first = plan.scenes.iter().find(is_own);
    let before = first
        .expect("it is in the plan")
        .at_frame(later.id.frame - 1);
    let frame = render_frame(&before, &plan.render, &plan.out, plan.monitor)?;
    store_frame(inputs, &frame, Some(&before), plan.monitor)
}
