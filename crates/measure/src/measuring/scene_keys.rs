//! Hashes of a scene's inputs: equal hashes mean equal pictures and scores.

use std::collections::BTreeMap;

use crate::{RenderFile, SHARP, hash_inputs};
use frame::Alignment;
use scene::SceneId;
use serde::Serialize;
use tracer::RenderSettings;

use crate::render::run_scene::RunScene;

/// Hashes of the inputs of one scene's frame and truths.
#[derive(Clone, Debug)]
pub(crate) struct SceneKeys {
    /// Hash of the program, and of what a case or a picture takes from the scene itself.
    scene: String,
    /// Hash of the frame's inputs.
    frame: String,
    /// Hashes of the inputs of every truth and its ladder.
    truths: BTreeMap<Alignment, [String; 2]>,
}

/// What all pictures and scores of a scene depend on.
#[derive(Serialize)]
struct SceneInputs<'a> {
    program: &'a str,
    scene: &'a SceneId,
    description: String,
}

/// What the frame and its pictures depend on.
#[derive(Serialize)]
struct FrameInputs<'a> {
    scene: &'a str,
    frame: &'a str,
}

/// What a truth, its ladder and its pictures depend on.
#[derive(Serialize)]
struct TruthInputs<'a> {
    scene: &'a str,
    truth: &'a [String; 2],
}

/// What the errors of a truth depend on.
#[derive(Serialize)]
struct ErrorInputs<'a> {
    scene: &'a str,
    frame: &'a str,
    truth: &'a [String; 2],
    parts: usize,
    rungs: &'a [u32],
}

/// What the scores of a case depend on.
#[derive(Serialize)]
struct CaseInputs<'a> {
    scene: &'a str,
    frame: &'a str,
    truths: [&'a [String; 2]; 2],
    has_ladder: bool,
    case: &'a str,
}

impl SceneKeys {
    /// Computes the hashes from the scene and the settings; reads no file.
    pub fn new(
        program: &str,
        scene: RunScene,
        settings: &RenderSettings,
        alignments: impl IntoIterator<Item = Alignment>,
    ) -> Self {
        let hash = |file| scene.content_hash(file, settings);
        Self {
            scene: hash_inputs(&SceneInputs {
                program,
                scene: scene.id(),
                description: scene.description_hash(),
            }),
            frame: hash(RenderFile::Frame),
            truths: (alignments.into_iter())
                .map(|alignment| {
                    let ladder = hash(RenderFile::Rung(alignment, SHARP));
                    (alignment, [hash(RenderFile::Truth(alignment)), ladder])
                })
                .collect(),
        }
    }

    /// Returns the hash for the frame and its pictures.
    pub fn frame(&self) -> String {
        hash_inputs(&FrameInputs {
            scene: &self.scene,
            frame: &self.frame,
        })
    }

    /// Returns the hash for a truth, its ladder and its pictures.
    pub fn truth(&self, alignment: Alignment) -> String {
        hash_inputs(&TruthInputs {
            scene: &self.scene,
            truth: &self.truths[&alignment],
        })
    }

    /// Returns the hash for the errors of a truth and of this many parts of it, with these rungs of
    /// its ladder.
    pub fn errors(&self, alignment: Alignment, parts: usize, rungs: &[u32]) -> String {
        hash_inputs(&ErrorInputs {
            scene: &self.scene,
            frame: &self.frame,
            truth: &self.truths[&alignment],
            parts,
            rungs,
        })
    }

    /// Returns the hash for a case with the hash of its own inputs, measured against its own truth
    /// and the common one, with their ladders or without.
    pub fn case(&self, case: &str, alignments: [Alignment; 2], has_ladder: bool) -> String {
        hash_inputs(&CaseInputs {
            scene: &self.scene,
            frame: &self.frame,
            truths: alignments.map(|alignment| &self.truths[&alignment]),
            has_ladder,
            case,
        })
    }
}
