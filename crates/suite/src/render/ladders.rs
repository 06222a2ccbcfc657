//! Ladders of sub-frame accumulations.

use std::path::{Path, PathBuf};

use frame::{Alignment, Ladder, Truth, read_attribute};
use tracer::{RenderSettings, Scene};

use crate::folder::scene_folder::scene_folder;
use crate::{Error, Monitor};

/// Sub-frame counts of the ladder that N_eq is read from.
pub const LADDER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// The ladder of one truth, the largest thing that measuring holds: it stays in its file until it is needed.
pub struct LadderFile<'a> {
    scene: &'a Scene,
    settings: RenderSettings,
    alignment: Alignment,
    path: PathBuf,
    /// Hash of the inputs.
    hash: String,
}

impl<'a> LadderFile<'a> {
    /// Names the ladder that goes with the truth of these settings, in `out`.
    pub fn new(
        scene: &'a Scene,
        settings: &RenderSettings,
        alignment: Alignment,
        out: &Path,
    ) -> Self {
        Self {
            scene,
            path: scene_folder(out, scene).join(format!("ladder_{alignment}.exr")),
            hash: ladder_hash(scene, settings, alignment),
            settings: *settings,
            alignment,
        }
    }

    /// Renders the ladder of `truth` and writes it, unless the file of the same inputs is there.
    pub fn ensure(&self, truth: &Truth, monitor: Monitor) -> Result<(), Error> {
        if read_attribute(&self.path, "content_hash").as_ref() == Some(&self.hash) {
            return Ok(());
        }
        self.render(truth, monitor)
    }

    /// Reads the ladder of `truth`; renders one that is missing, broken or made from other inputs.
    pub fn read_or_render(&self, truth: &Truth, monitor: Monitor) -> Result<Ladder, Error> {
        if let Ok(found) = Ladder::read(&self.path)
            && found.provenance.content_hash == self.hash
        {
            return Ok(found);
        }
        self.render(truth, monitor)?;
        Ok(Ladder::read(&self.path)?)
    }

    fn render(&self, truth: &Truth, monitor: Monitor) -> Result<(), Error> {
        let (scene, settings) = (self.scene, &self.settings);
        let label = format!("{} sub-frames, {}", scene.name, self.alignment);
        let ladder = monitor.watch(&label, |watch| {
            tracer::trace_ladder(scene, settings, truth, &LADDER, watch)
        })?;
        assert_eq!(
            ladder.provenance.content_hash, self.hash,
            "{label}: the hash must not depend on the render"
        );
        Ok(ladder.write(&self.path)?)
    }
}

/// Hashes the inputs of the ladder that goes with the truth of these settings.
pub(crate) fn ladder_hash(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
) -> String {
    tracer::ladder_hash(scene, settings, alignment, &LADDER)
}
