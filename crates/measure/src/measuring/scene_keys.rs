//! Hashes of a scene's inputs: equal hashes mean equal pictures and scores.

use std::collections::BTreeMap;

use crate::hash_inputs;
use frame::Alignment;
use tracer::RenderSettings;

use crate::measuring::run_scene::RunScene;
use crate::render::ladders::ladder_hash;

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

impl SceneKeys {
    /// Computes the hashes from the scene and the settings; reads no file.
    pub fn new(
        program: &str,
        scene: RunScene,
        settings: &RenderSettings,
        alignments: impl IntoIterator<Item = Alignment>,
    ) -> Self {
        let (description, frame) = match scene {
            RunScene::Traced(scene) => (
                hash_inputs(&(&scene.exposes, scene.family, &scene.display)),
                tracer::frame_hash(scene, settings),
            ),
            RunScene::Drawn(scene) => (hash_inputs(scene), scene.hash.clone()),
        };
        let ladder = |alignment| match scene {
            RunScene::Traced(scene) => ladder_hash(scene, settings, alignment),
            RunScene::Drawn(scene) => scene.hash.clone(),
        };
        Self {
            scene: hash_inputs(&(program, scene.id(), description)),
            frame,
            truths: (alignments.into_iter())
                .map(|alignment| {
                    let truth = scene.truth_hash(settings, alignment);
                    (alignment, [truth, ladder(alignment)])
                })
                .collect(),
        }
    }

    /// Returns the hash for the frame and its pictures.
    pub fn frame(&self) -> String {
        hash_inputs(&(&self.scene, &self.frame))
    }

    /// Returns the hash for a truth, its ladder and its pictures.
    pub fn truth(&self, alignment: Alignment) -> String {
        hash_inputs(&(&self.scene, &self.truths[&alignment]))
    }

    /// Returns the hash for a case with its own inputs, measured against its own truth and the
    /// common one, with their ladders or without.
    pub fn case(&self, inputs: &str, alignments: [Alignment; 2], has_ladder: bool) -> String {
        let truths = alignments.map(|alignment| &self.truths[&alignment]);
        hash_inputs(&(&self.scene, &self.frame, truths, has_ladder, inputs))
    }
}
