//! Files of the replicates of a truth.

use std::ops::Range;
use std::path::PathBuf;

use frame::{Alignment, Replicate, Truth, read_attribute, truth_hash};
use store::RenderFile;
use tracer::{RenderSettings, Scene, TruthTracer};

use crate::{Error, Monitor};

/// The place of one truth's replicates, and the hash of their inputs.
pub struct ReplicateFiles {
    /// Folder of the scene's files.
    pub folder: PathBuf,
    /// The truth's alignment.
    pub alignment: Alignment,
    /// Content hash that every replicate must have.
    pub hash: String,
}

impl ReplicateFiles {
    /// Names the files of the truth that `settings` ask for, below a scene's folder.
    pub fn new(
        folder: PathBuf,
        scene: &Scene,
        settings: &RenderSettings,
        alignment: Alignment,
    ) -> Self {
        Self {
            folder,
            alignment,
            hash: tracer::replicate_hash(scene, settings, alignment),
        }
    }

    /// Names the file of the truth that is made of the replicates.
    pub fn truth_path(&self) -> PathBuf {
        self.folder.join(RenderFile::Truth(self.alignment).path())
    }

    /// Returns replicates by their indices. Reads those that are there; renders the others and writes each as soon as it is
    /// whole. Replaces a file that is broken or was made from other inputs.
    pub fn read_or_render(
        &self,
        scene: &Scene,
        settings: &RenderSettings,
        indices: Range<u32>,
        monitor: Monitor,
    ) -> Result<Vec<Replicate>, Error> {
        let mut tracer = None;
        let mut replicates = Vec::new();
        for index in indices {
            if let Some(found) = self.read(index) {
                replicates.push(found);
                continue;
            }
            let own = std::slice::from_ref(self);
            replicates.extend(render_replicate(
                own,
                index,
                scene,
                settings,
                &mut tracer,
                monitor,
            )?);
        }
        Ok(replicates)
    }

    /// Returns true if the header of the truth's file names this many of these replicates.
    pub(super) fn has_truth(&self, replicates: u32) -> bool {
        let found = read_attribute(&self.truth_path(), "content_hash");
        found == Some(truth_hash(&self.hash, replicates))
    }

    /// Reads the truth of this many of these replicates; none where the file is missing, broken or made from other inputs.
    pub(super) fn read_truth(&self, replicates: u32) -> Option<Truth> {
        let found = (self.has_truth(replicates)).then(|| Truth::read(&self.truth_path()))?;
        let hash = truth_hash(&self.hash, replicates);
        (found.ok()).filter(|found| found.provenance.is_rendered_of(&hash))
    }

    /// Reads a replicate; none where it is missing, broken or made from other inputs.
    pub(super) fn read(&self, index: u32) -> Option<Replicate> {
        let found = Replicate::read(&self.path(index)).ok()?;
        let is_own = found.provenance.is_rendered_of(&self.hash) && found.index == index;
        is_own.then_some(found)
    }

    /// Names the file of a replicate.
    pub(crate) fn path(&self, index: u32) -> PathBuf {
        self.folder
            .join(RenderFile::Replicate(self.alignment, index).path())
    }

    /// Tells whether a replicate's header names these inputs: a render reads such a file instead of tracing it.
    pub(crate) fn has(&self, index: u32) -> bool {
        read_attribute(&self.path(index), "content_hash").as_ref() == Some(&self.hash)
    }
}

/// Traces a replicate of each of several truths together, and writes each to its file. `tracer` is made for the first replicate.
pub(super) fn render_replicate<'a>(
    files: &[ReplicateFiles],
    index: u32,
    scene: &'a Scene,
    settings: &RenderSettings,
    tracer: &mut Option<TruthTracer<'a>>,
    monitor: Monitor,
) -> Result<Vec<Replicate>, Error> {
    let alignments: Vec<Alignment> = files.iter().map(|files| files.alignment).collect();
    let tracer = match tracer {
        Some(tracer) => tracer,
        none => none.insert(TruthTracer::new(scene, settings, &alignments)?),
    };
    let names: Vec<&str> = alignments
        .iter()
        .map(|alignment| alignment.name())
        .collect();
    let label = format!("{} {}, replicate {index}", scene.id, names.join(" and "));
    let replicates = monitor.watch(&label, |watch| tracer.trace(index, watch))?;
    for (files, replicate) in files.iter().zip(&replicates) {
        replicate.write(&files.path(index))?;
    }
    Ok(replicates)
}
