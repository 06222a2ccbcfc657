//! A scene of a run: traced by this program, or ingested from an engine's pictures. Nothing else
//! asks which: the files of both have the same names, and the hashes of their inputs.

use std::path::{Path, PathBuf};

use scene::{Family, Scene, SceneId};

use crate::{Error, LADDER, RenderFile, hash_inputs};
use frame::{Alignment, Display};
use serde::Serialize;
use tracer::RenderSettings;

use super::ingested_scene::{Drawn, IngestedScene};
use super::memory::{Measured, bound_memory, count_measured, refuse_beyond_free};

/// Lists the rungs that measuring against a truth needs: all if ladders are requested. Otherwise
/// only the sharp picture of the shutter's middle, the zero of skill, unless that is the frame
/// itself.
pub(crate) fn needed_rungs(alignment: Alignment, ladders: bool) -> &'static [u32] {
    match (ladders, alignment) {
        (true, _) => &LADDER,
        (false, Alignment::Centred) => &[],
        (false, _) => &LADDER[..1],
    }
}

/// A scene of a run.
#[derive(Clone, Copy, Debug)]
pub enum RunScene<'a> {
    /// Frame and truths are rendered where they are missing.
    Traced(&'a Scene),
    /// Frame and truth are copied from the folder that `ingest` wrote.
    Ingested(&'a IngestedScene),
}

/// What a case or a picture takes from a scene that rays are traced in.
#[derive(Serialize)]
struct TracedDescription<'a> {
    exposes: &'a str,
    family: Family,
    display: &'a Display,
}

impl<'a> From<&'a Scene> for RunScene<'a> {
    fn from(scene: &'a Scene) -> Self {
        Self::Traced(scene)
    }
}

impl<'a> RunScene<'a> {
    /// Returns the scene's identity.
    pub fn id(self) -> &'a SceneId {
        match self {
            Self::Traced(scene) => &scene.id,
            Self::Ingested(scene) => &scene.id,
        }
    }

    /// Returns the scene that rays are traced in; none if an engine drew it.
    pub fn traced(self) -> Option<&'a Scene> {
        match self {
            Self::Traced(scene) => Some(scene),
            Self::Ingested(_) => None,
        }
    }

    /// Returns the ingested scene; none if rays are traced.
    pub fn ingested(self) -> Option<&'a IngestedScene> {
        match self {
            Self::Traced(_) => None,
            Self::Ingested(scene) => Some(scene),
        }
    }

    /// Returns whether the motion of what it shows is not known.
    pub(crate) fn lacks_velocity(self) -> bool {
        self.ingested().is_some_and(IngestedScene::lacks_velocity)
    }

    /// Returns the family (none for an engine's scene), and what the scene exposes.
    pub(crate) fn describe(self) -> (Option<Family>, String) {
        match self {
            Self::Traced(scene) => (Some(scene.family), scene.exposes.clone()),
            Self::Ingested(scene) => (None, scene.exposes()),
        }
    }

    /// Names the engine that drew the frame and the truth; none if rays are traced.
    pub(crate) fn drawn(self) -> Option<Drawn> {
        self.ingested().map(IngestedScene::drawn)
    }

    /// Returns the engine that the files of the scene name.
    pub(crate) fn engine(self) -> Option<&'a str> {
        self.ingested().map(|scene| &*scene.engine)
    }

    /// Returns the settings of the scene's files: a run's, or those of an engine's sub-frames.
    pub(crate) fn settings(self, run: RenderSettings) -> RenderSettings {
        match self {
            Self::Traced(_) => run,
            Self::Ingested(scene) => scene.settings(run),
        }
    }

    /// Lists the alignments of a plan that the scene has truths of.
    pub(crate) fn alignments(self, planned: Vec<Alignment>) -> Vec<Alignment> {
        match self {
            Self::Traced(_) => planned,
            Self::Ingested(scene) => vec![scene.alignment],
        }
    }

    /// Lists the numbers of sub-frames in its ladder; a rendered ladder is complete only if the
    /// plan asks for it.
    pub(crate) fn rungs(self, ladders: bool) -> &'a [u32] {
        match self {
            Self::Traced(_) if ladders => &LADDER,
            Self::Traced(_) => &[],
            Self::Ingested(scene) => &scene.ladder,
        }
    }

    /// Lists the rungs that measuring against a truth needs.
    pub(crate) fn needed_rungs(self, alignment: Alignment, ladders: bool) -> &'a [u32] {
        match self {
            Self::Traced(_) => needed_rungs(alignment, ladders),
            Self::Ingested(scene) => &scene.ladder,
        }
    }

    /// Lists the accumulations that a truth of an alignment can be compared with: the sharp picture
    /// of the shutter's middle, unless that is the frame itself, then those of the plan, which may
    /// ask for rendered ladders.
    pub(crate) fn accumulations(
        self,
        planned: &[u32],
        alignment: Alignment,
        ladders: bool,
    ) -> Vec<u32> {
        let rungs = self.rungs(ladders);
        let sharp = needed_rungs(alignment, false).iter();
        let others = planned.iter().filter(|count| rungs.contains(count));
        sharp.chain(others).copied().collect()
    }

    /// Names the folder that the scene's finished files are taken from: an engine's own one, or the
    /// scene's in a folder of truths.
    pub(crate) fn source(self, truths: Option<&Path>) -> Option<PathBuf> {
        match self {
            Self::Traced(scene) => Some(truths?.join(scene.id.folder())),
            Self::Ingested(scene) => Some(scene.folder.clone()),
        }
    }

    /// Hashes what a case or a picture takes from the scene itself.
    pub(crate) fn description_hash(self) -> String {
        match self {
            Self::Traced(scene) => hash_inputs(&TracedDescription {
                exposes: &scene.exposes,
                family: scene.family,
                display: &scene.display,
            }),
            Self::Ingested(scene) => scene.description_hash(),
        }
    }

    /// Returns the hash of the inputs of one of the scene's files.
    pub(crate) fn content_hash(self, file: RenderFile, settings: &RenderSettings) -> String {
        let scene = match self {
            Self::Traced(scene) => scene,
            Self::Ingested(scene) => return scene.content_hash(file),
        };
        match file {
            RenderFile::Frame => tracer::frame_hash(scene, settings),
            RenderFile::Truth(alignment) => tracer::truth_hash(scene, settings, alignment),
            RenderFile::Replicate(alignment, _) => {
                tracer::replicate_hash(scene, settings, alignment)
            }
            RenderFile::Rung(alignment, _) => {
                tracer::ladder_hash(scene, settings, alignment, &LADDER)
            }
        }
    }

    /// Refuses settings that the scene cannot be measured with, and too little memory.
    pub(crate) fn check(self, settings: &RenderSettings, measured: Measured) -> Result<(), Error> {
        match self {
            Self::Traced(scene) => {
                settings.check_frame(scene)?;
                refuse_beyond_free(scene, settings, count_measured(settings, measured))
            }
            Self::Ingested(scene) => scene.check_truth(),
        }
    }

    /// Bounds the memory needed to measure, in bytes; 0 for a scene that is not rendered.
    pub(crate) fn memory(self, settings: &RenderSettings, measured: Measured) -> u64 {
        self.traced().map_or(0, |scene| {
            bound_memory(scene, settings, count_measured(settings, measured))
        })
    }
}
