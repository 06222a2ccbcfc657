//! Every frame of every scene of a plan.

use crate::hash_program;
use filters::Gpu;

use super::plan::RunPlan;
use super::scene::SceneContext;

/// Visits every scene of a plan and, after each, its later frames, with one frame at a time in
/// memory.
pub(super) fn visit_frames<E>(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    mut visit: impl FnMut(&SceneContext) -> Result<(), E>,
) -> Result<(), E> {
    let program = hash_program();
    let program = program.as_deref();
    for scene in plan.all_scenes() {
        visit(&SceneContext::new(plan, gpu, program, scene))?;
        // An engine's scene has one frame; plans with more are refused.
        let Some(scene) = scene.traced() else {
            continue;
        };
        for frame in 1..plan.frames.count {
            let later = scene.at_frame(frame);
            visit(&SceneContext::new(plan, gpu, program, (&later).into()))?;
        }
    }
    Ok(())
}

/// Counts the frames of all scenes.
pub(super) fn count_frames(plan: &RunPlan) -> usize {
    plan.scenes.len() * plan.frames.count as usize + plan.ingested.len()
}
