//! Hashes of a scene's inputs: equal hashes mean equal pictures and scores.

use std::collections::BTreeMap;

use frame::Alignment;
use tracer::{RenderSettings, Scene};

use super::record::hash_inputs;
use crate::render::ladders::ladder_hash;
use crate::render::settings::frame_settings;

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
        scene: &Scene,
        settings: &RenderSettings,
        alignments: impl IntoIterator<Item = Alignment>,
    ) -> Self {
        let Scene {
            name,
            exposes,
            family,
            display,
            ..
        } = scene;
        Self {
            scene: hash_inputs(&(program, name, exposes, family, display)),
            frame: tracer::frame_hash(scene, &frame_settings(settings)),
            truths: (alignments.into_iter())
                .map(|alignment| {
                    let truth = tracer::truth_hash(scene, settings, alignment);
                    (alignment, [truth, ladder_hash(scene, settings, alignment)])
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

    /// Returns the hash for a case with such inputs of its own, measured against these two truths.
    pub fn case(&self, own: &str, alignment: Alignment, common: Alignment) -> String {
        let truths = [alignment, common].map(|alignment| &self.truths[&alignment]);
        hash_inputs(&(&self.scene, &self.frame, truths, own))
    }
}
