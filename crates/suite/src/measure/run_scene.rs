//! A scene of a run: rendered from its files, or drawn by an engine.

use frame::Alignment;
use scene::{Family, Scene, SceneId};
use store::LADDER;
use tracer::RenderSettings;

use crate::Error;
use crate::engine_scene::EngineScene;
use crate::render::ladders::needed_rungs;
use crate::render::memory::{Measured, bound_memory, count_measured, refuse_beyond_free};
use crate::run::case::Drawn;

/// A scene of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RunScene<'a> {
    /// Frame and truth are rendered.
    Traced(&'a Scene),
    /// Frame and truth were drawn by an engine, and are copied.
    Drawn(&'a EngineScene),
}

impl<'a> RunScene<'a> {
    /// Returns the scene's identity.
    pub fn id(self) -> &'a SceneId {
        match self {
            Self::Traced(scene) => &scene.id,
            Self::Drawn(scene) => &scene.id,
        }
    }

    /// Returns the scene that frame and truth are rendered from; none if an engine drew them.
    pub fn traced(self) -> Option<&'a Scene> {
        match self {
            Self::Traced(scene) => Some(scene),
            Self::Drawn(_) => None,
        }
    }

    /// Returns the family (none for an engine's scene), and what the scene exposes.
    pub fn describe(self) -> (Option<Family>, String) {
        match self {
            Self::Traced(scene) => (Some(scene.family), scene.exposes.clone()),
            Self::Drawn(scene) => (None, scene.exposes()),
        }
    }

    /// Names the engine that drew the frame and the truth; none if both are rendered.
    pub fn drawn(self) -> Option<Drawn> {
        match self {
            Self::Traced(_) => None,
            Self::Drawn(scene) => Some(Drawn {
                engine: scene.engine.clone(),
                scene: scene.scene.clone(),
                subframes: scene.subframes,
                step: scene.step,
            }),
        }
    }

    /// Lists the alignments of a plan that the scene has truths of.
    pub fn alignments(self, planned: Vec<Alignment>) -> Vec<Alignment> {
        match self {
            Self::Traced(_) => planned,
            Self::Drawn(scene) => vec![scene.alignment],
        }
    }

    /// Lists the numbers of sub-frames in its ladder; a rendered ladder is complete only if the
    /// plan asks for it.
    pub fn rungs(self, ladders: bool) -> &'a [u32] {
        match self {
            Self::Traced(_) if ladders => &LADDER,
            Self::Traced(_) => &[],
            Self::Drawn(scene) => &scene.ladder,
        }
    }

    /// Lists the accumulations that a truth of an alignment can be compared with: the sharp picture
    /// of the shutter's middle, unless that is the frame itself, then those of the plan, which may
    /// ask for rendered ladders.
    pub fn accumulations(self, planned: &[u32], alignment: Alignment, ladders: bool) -> Vec<u32> {
        let rungs = self.rungs(ladders);
        let sharp = needed_rungs(alignment, false).iter();
        let others = planned.iter().filter(|count| rungs.contains(count));
        sharp.chain(others).copied().collect()
    }

    /// Returns the content hash of the truth of one alignment.
    pub fn truth_hash(self, settings: &RenderSettings, alignment: Alignment) -> String {
        match self {
            Self::Traced(scene) => tracer::truth_hash(scene, settings, alignment),
            Self::Drawn(scene) => scene.truth_hash(),
        }
    }

    /// Refuses settings that the scene cannot be measured with, and too little memory.
    pub fn check(self, settings: &RenderSettings, measured: Measured) -> Result<(), Error> {
        match self {
            Self::Traced(scene) => {
                settings.check_frame(scene)?;
                refuse_beyond_free(scene, settings, count_measured(settings, measured))
            }
            Self::Drawn(scene) => scene.check_truth(),
        }
    }

    /// Bounds the memory needed to measure, in bytes; 0 for a scene that is not rendered.
    pub fn memory(self, settings: &RenderSettings, measured: Measured) -> u64 {
        match self {
            Self::Traced(scene) => {
                bound_memory(scene, settings, count_measured(settings, measured))
            }
            Self::Drawn(_) => 0,
        }
    }
}
