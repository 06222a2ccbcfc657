//! A scene of a run: rendered from its files, or drawn by an engine.

use std::path::{Path, PathBuf};

use frame::Alignment;
use store::LADDER;
use tracer::{Family, RenderSettings, Scene, SceneId};

use crate::Error;
use crate::engine_scene::EngineScene;
use crate::render::ladders::{SHARP, needed_rungs};
use crate::render::memory::{bound_memory, count_measured, refuse_beyond_free};
use crate::render::settings::frame_settings;
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

    /// Returns the scene that frame and truth are rendered of; none where an engine drew them.
    pub fn traced(self) -> Option<&'a Scene> {
        match self {
            Self::Traced(scene) => Some(scene),
            Self::Drawn(_) => None,
        }
    }

    /// Returns the frame of the scene's own clock, by which the noise of filters changes.
    pub fn frame_index(self) -> u32 {
        self.traced().map_or(0, |scene| scene.id.frame)
    }

    /// Returns the family; none of an engine's scene.
    pub fn family(self) -> Option<Family> {
        match self {
            Self::Traced(scene) => Some(scene.family),
            Self::Drawn(_) => None,
        }
    }

    /// Says what the scene exposes.
    pub fn exposes(self) -> String {
        match self {
            Self::Traced(scene) => scene.exposes.clone(),
            Self::Drawn(scene) => scene.exposes(),
        }
    }

    /// Says who drew the frame and the truth; none where both are rendered.
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

    /// Names the folder of the scene's files below `out`.
    pub fn folder(self, out: &Path) -> PathBuf {
        out.join(self.id().folder())
    }

    /// Lists the shutter alignments that there are truths of, among those of a plan.
    pub fn alignments(self, planned: Vec<Alignment>) -> Vec<Alignment> {
        match self {
            Self::Traced(_) => planned,
            Self::Drawn(scene) => vec![scene.alignment],
        }
    }

    /// Lists the numbers of sub-frames of its ladder, as far as a plan asks for ladders that are rendered.
    pub fn rungs(self, ladders: bool) -> &'a [u32] {
        match self {
            Self::Traced(_) if ladders => &LADDER,
            Self::Traced(_) => &[],
            Self::Drawn(scene) => &scene.ladder,
        }
    }

    /// Lists the accumulations that the truth of an alignment can be compared with: the sharp picture of the shutter's middle,
    /// unless the frame is that, then those of a plan that asks for rendered ladders or not.
    pub fn accumulations(self, planned: &[u32], alignment: Alignment, ladders: bool) -> Vec<u32> {
        let rungs = self.rungs(ladders);
        let sharp = [SHARP].into_iter();
        sharp
            .filter(|rung| needed_rungs(alignment, false).contains(rung))
            .chain(
                planned
                    .iter()
                    .copied()
                    .filter(|count| rungs.contains(count)),
            )
            .collect()
    }

    /// Returns the content hash of the truth of one alignment.
    pub fn truth_hash(self, settings: &RenderSettings, alignment: Alignment) -> String {
        match self {
            Self::Traced(scene) => tracer::truth_hash(scene, settings, alignment),
            Self::Drawn(scene) => scene.truth_hash(),
        }
    }

    /// Refuses settings with which the scene cannot be measured, and too little memory for this many truths.
    pub fn check(
        self,
        settings: &RenderSettings,
        truths: usize,
        forms: usize,
    ) -> Result<(), Error> {
        match self {
            Self::Traced(scene) => {
                frame_settings(settings).check_frame(scene)?;
                refuse_beyond_free(scene, settings, count_measured(settings, truths, forms))
            }
            Self::Drawn(scene) => scene.check_truth(),
        }
    }

    /// Bounds the bytes of memory that measuring takes against this many truths, with this many forms of the frame; nothing for a
    /// scene that is not rendered.
    pub fn memory(self, settings: &RenderSettings, truths: usize, forms: usize) -> u64 {
        match self {
            Self::Traced(scene) => {
                bound_memory(scene, settings, count_measured(settings, truths, forms))
            }
            Self::Drawn(_) => 0,
        }
    }
}
