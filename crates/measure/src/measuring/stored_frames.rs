//! The frame in the forms that filters get, and the previous frame for filters that read it.

use frame::{Frame, Picture};
use scene::Scene;

use super::plan::RunPlan;
use crate::Error;
use crate::inputs::input_format::InputFormat;
use crate::render::exclusion::{FilterFrame, write_exclusion};
use crate::render::run_scene::RunScene;
use crate::render::velocities::write_further_velocities;
use crate::stats::parts::Groups;

/// A frame in one of the forms that filters get.
pub(crate) struct StoredFrame {
    pub format: InputFormat,
    pub frame: FilterFrame,
    /// Its colour and coverage, for parts of its replicates; empty if scores get no intervals.
    pub parts: Vec<Picture>,
    /// The previous frame; none for the first frame, and if no filter reads it.
    pub before: Option<FilterFrame>,
    /// The previous frame's colour and coverage, like `parts`.
    pub parts_before: Vec<Picture>,
}

/// Stores a scene's frame and its replicates in every form, and the previous frame for filters with
/// history.
pub(super) fn store_frames(
    plan: &RunPlan,
    scene: RunScene,
    formats: &[InputFormat],
    frame: &Frame,
    replicates: &[Picture],
) -> Result<Vec<StoredFrame>, Error> {
    let whole = read_further_velocities(plan, scene)?;
    if let Some(whole) = whole.as_ref().filter(|_| scene.id().frame == 0) {
        write_further_velocities(whole, &plan.out.join(scene.id().folder()))?;
    }
    let frame = whole.as_ref().unwrap_or(frame);
    let before = read_frame_before(plan, scene)?;
    let replicates_before = match &before {
        Some((scene, _)) => read_replicates(plan, scene.into())?,
        None => Vec::new(),
    };
    let groups = Groups::of(plan.render.replicates);
    let store = |format: &InputFormat, frame: &Frame, replicates: &[Picture], scene: RunScene| {
        let (frame, replicates) = format.apply(frame, replicates, scene.traced(), plan.monitor)?;
        let parts = if replicates.is_empty() {
            Vec::new()
        } else {
            (groups.list())
                .map(|group| groups.picture_without(group, &replicates))
                .collect()
        };
        let exclusion = if plan.reads_exclusion() {
            plan.rendering(scene).exclusion(&frame)?
        } else {
            None
        };
        Ok::<_, Error>((FilterFrame { frame, exclusion }, parts))
    };
    let stored: Vec<StoredFrame> = (formats.iter())
        .map(|format| {
            let before = before.as_ref();
            let before =
                before.map(|(scene, frame)| store(format, frame, &replicates_before, scene.into()));
            let (before, parts_before) = before.transpose()?.unzip();
            let (frame, parts) = store(format, frame, replicates, scene)?;
            Ok(StoredFrame {
                format: *format,
                frame,
                parts,
                before,
                parts_before: parts_before.unwrap_or_default(),
            })
        })
        .collect::<Result<_, Error>>()?;
    let mut usual = stored
        .iter()
        .filter(|frame| frame.format == InputFormat::default());
    if let (Some(StoredFrame { frame, .. }), 0) = (usual.next(), scene.id().frame) {
        let folder = plan.out.join(scene.id().folder());
        let mask = frame.exclusion.as_ref();
        mask.map_or(Ok(()), |mask| write_exclusion(mask, frame, &folder))?;
    }
    Ok(stored)
}

/// Reads the replicates of a scene's frame if filters are measured on parts of them.
pub(super) fn read_replicates(plan: &RunPlan, scene: RunScene) -> Result<Vec<Picture>, Error> {
    if plan.measures_parts(scene) {
        plan.rendering(scene).frame_replicates()
    } else {
        Ok(Vec::new())
    }
}

/// Reads the frame with the velocities that few filters read; none if no filter of the plan does,
/// or if an engine gave them with the frame.
fn read_further_velocities(plan: &RunPlan, scene: RunScene) -> Result<Option<Frame>, Error> {
    let is_read = plan.reads_further_velocities() && scene.traced().is_some();
    is_read
        .then(|| plan.rendering(scene).frame_with_further_velocities())
        .transpose()
}

/// Reads the frame before a later frame, with its scene.
fn read_frame_before(plan: &RunPlan, scene: RunScene) -> Result<Option<(Scene, Frame)>, Error> {
    let mut filters = plan.filters.iter();
    let has_history = filters.any(|choice| !choice.filter.history.is_empty());
    let later = scene
        .traced()
        .filter(|scene| has_history && scene.id.frame > 0);
    let Some(later) = later else {
        return Ok(None);
    };
    let is_own = |scene: &&Scene| scene.id == later.id.at_frame(0);
    let first = plan.scenes.iter().find(is_own).expect("it is in the plan");
    let before = first.at_frame(later.id.frame - 1);
    let frame = match read_further_velocities(plan, (&before).into())? {
        Some(whole) => whole,
        None => plan.rendering((&before).into()).frame()?,
    };
    Ok(Some((before, frame)))
}
