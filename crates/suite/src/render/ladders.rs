//! Ladders of sub-frame accumulations.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use frame::{Alignment, Ladder, Truth, read_attribute, rung_file};
use tracer::{LadderTracer, RenderSettings, Scene};

use super::kept::is_rendered_of;
use crate::folder::scene_folder::scene_folder;
use crate::{Error, Monitor};

/// Sub-frame counts of the ladder that N_eq is read from.
pub const LADDER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];

/// Names the folder of the rungs of a ladder in the folder of its scene.
pub(crate) fn ladder_folder(alignment: Alignment) -> String {
    format!("ladder_{alignment}")
}

/// The ladder of one truth, with a file for each rung: all of them together would take more memory than all else that measuring
/// holds.
pub struct LadderFiles<'a> {
    scene: &'a Scene,
    settings: RenderSettings,
    truth: &'a Truth,
    folder: PathBuf,
    /// Hash of the inputs.
    hash: String,
    /// Made for the first rung that is rendered.
    tracer: OnceCell<LadderTracer<'a>>,
}

impl<'a> LadderFiles<'a> {
    /// Names the ladder that goes with a truth, which was rendered with these settings, in `out`.
    pub fn new(scene: &'a Scene, settings: &RenderSettings, truth: &'a Truth, out: &Path) -> Self {
        Self {
            scene,
            folder: scene_folder(out, scene).join(ladder_folder(truth.alignment)),
            hash: ladder_hash(scene, settings, truth.alignment),
            settings: *settings,
            truth,
            tracer: OnceCell::new(),
        }
    }

    /// Renders the rungs and writes them, but for those whose files of the same inputs are there.
    pub fn ensure(&self, monitor: Monitor) -> Result<(), Error> {
        for subframes in LADDER {
            let found = read_attribute(&self.path(subframes), "content_hash");
            if found.as_ref() != Some(&self.hash) {
                self.render(subframes, monitor)?;
            }
        }
        Ok(())
    }

    /// Reads one rung; renders it if it is missing, broken or made from other inputs.
    pub fn read_or_render(&self, subframes: u32, monitor: Monitor) -> Result<Ladder, Error> {
        let path = self.path(subframes);
        if let Ok(found) = Ladder::read_rung(&path, subframes)
            && is_rendered_of(&found.provenance, &self.hash)
        {
            return Ok(found);
        }
        self.render(subframes, monitor)?;
        Ok(Ladder::read_rung(&path, subframes)?)
    }

    fn path(&self, subframes: u32) -> PathBuf {
        self.folder.join(rung_file(subframes))
    }

    fn render(&self, subframes: u32, monitor: Monitor) -> Result<(), Error> {
        let label = format!(
            "{} {subframes} sub-frames, {}",
            self.scene.name, self.truth.alignment
        );
        let rung = monitor.watch(&label, |watch| self.tracer()?.trace(subframes, watch))?;
        assert_eq!(
            rung.provenance.content_hash, self.hash,
            "{label}: the hash must not depend on the render"
        );
        Ok(rung.write(&self.path(subframes))?)
    }

    fn tracer(&self) -> Result<&LadderTracer<'a>, tracer::TraceError> {
        if self.tracer.get().is_none() {
            let made = LadderTracer::new(self.scene, &self.settings, self.truth, &LADDER)?;
            // It was empty, and no other thread can see it.
            let _ = self.tracer.set(made);
        }
        Ok(self.tracer.get().expect("it was made"))
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
