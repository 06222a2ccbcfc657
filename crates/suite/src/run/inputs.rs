//! Hashes of a scene's inputs: equal hashes mean equal pictures and equal scores.

use std::collections::BTreeMap;

use frame::Alignment;
use tracer::Scene;

use crate::RenderSettings;
use crate::render::rendered::{frame_settings, ladder_hash, truth_settings};
use crate::run::kept::hash_of;

/// The inputs of one scene's frame and truths.
#[derive(Clone, Debug)]
pub(crate) struct SceneInputs {
    /// The program, and what a case or a picture takes from the scene itself.
    scene: String,
    /// Of the frame.
    frame: String,
    /// Of every truth and its ladder.
    truths: BTreeMap<Alignment, [String; 2]>,
}

impl SceneInputs {
    /// Computed from the scene and the settings: no file is read.
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
            scene: hash_of(&(program, name, exposes, family, display)),
            frame: tracer::frame_hash(scene, &frame_settings(scene, settings)),
            truths: (alignments.into_iter())
                .map(|alignment| {
                    let settings = truth_settings(scene, settings, alignment);
                    let truth = tracer::truth_hash(scene, &settings);
                    (alignment, [truth, ladder_hash(scene, &settings)])
                })
                .collect(),
        }
    }

    /// Of the frame and its pictures.
    pub fn frame(&self) -> String {
        hash_of(&(&self.scene, &self.frame))
    }

    /// Of a truth, its ladder and its pictures.
    pub fn truth(&self, alignment: Alignment) -> String {
        hash_of(&(&self.scene, &self.truths[&alignment]))
    }

    /// Of a case with such inputs of its own, measured against these two truths.
    pub fn case(&self, own: &str, alignment: Alignment, common: Alignment) -> String {
        let truths = [alignment, common].map(|alignment| &self.truths[&alignment]);
        hash_of(&(&self.scene, &self.frame, truths, own))
    }
}
