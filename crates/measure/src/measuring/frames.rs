//! Every frame of a scene of a plan.

use crate::render::run_scene::RunScene;
use filters::Gpu;

use super::plan::RunPlan;
use super::scene::SceneContext;

/// Visits a scene of a plan and its later frames, with one frame at a time in memory. `program` is
/// the hash of this program; none if it cannot be hashed.
pub(super) fn visit_frames<E>(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    program: Option<&str>,
    scene: RunScene,
    mut visit: impl FnMut(&SceneContext) -> Result<(), E>,
) -> Result<(), E> {
    visit(&SceneContext::new(plan, gpu, program, scene))?;
    // An engine's scene has one frame; plans with more are refused.
    let Some(scene) = scene.traced() else {
        return Ok(());
    };
    for frame in 1..plan.frames.count {
        let later = scene.at_frame(frame);
        visit(&SceneContext::new(plan, gpu, program, (&later).into()))?;
    }
    Ok(())
}

impl RunPlan {
    /// Counts the steps of a frame of a scene, as progress shows them: rendering and measuring.
    pub(super) fn steps(&self) -> u64 {
        self.render_steps() + 1
    }

    /// Counts a frame and the truths.
    pub(super) fn render_steps(&self) -> u64 {
        1 + self.alignments().len() as u64 * self.truth_steps()
    }

    /// Counts the replicates of a truth, and its ladder.
    pub(super) fn truth_steps(&self) -> u64 {
        u64::from(self.render.replicates) + 1
    }
}

/// Counts the frames of all scenes.
pub(super) fn count_frames(plan: &RunPlan) -> usize {
    plan.scenes.len() * plan.frames.count as usize + plan.ingested.len()
}
