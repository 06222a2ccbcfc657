//! Files of a truth and of its replicates.

use std::ops::Range;
use std::path::{Path, PathBuf};

use frame::{Alignment, Replicate, Truth, read_attribute, truth_hash};
use store::{RenderFile, scene_folder};
use tracer::{RenderSettings, Scene, TruthTracer};

use super::memory::check_memory;
use crate::{Error, Monitor};

/// The files of one truth below an output folder, and the hash of their inputs.
pub(crate) struct TruthFiles<'a> {
    scene: &'a Scene,
    settings: RenderSettings,
    alignment: Alignment,
    /// Folder of the scene's files.
    folder: PathBuf,
    /// Content hash that every replicate must have.
    hash: String,
    monitor: Monitor,
}

impl<'a> TruthFiles<'a> {
    /// Names the files of the truth that `settings` ask for, below `out`.
    pub fn new(
        scene: &'a Scene,
        settings: &RenderSettings,
        alignment: Alignment,
        out: &Path,
        monitor: Monitor,
    ) -> Self {
        Self {
            scene,
            settings: *settings,
            alignment,
            folder: scene_folder(out, scene),
            hash: tracer::replicate_hash(scene, settings, alignment),
            monitor,
        }
    }

    /// Names the file of the truth that is made of the replicates.
    pub fn truth_path(&self) -> PathBuf {
        self.folder.join(RenderFile::Truth(self.alignment).path())
    }

    /// Reads the truth; none where the file is missing, broken or made from other inputs.
    pub fn read_truth(&self) -> Option<Truth> {
        let count = self.settings.replicates;
        let found = (self.has_truth(count)).then(|| Truth::read(&self.truth_path()))?;
        let hash = truth_hash(&self.hash, count);
        (found.ok()).filter(|found| found.provenance.is_rendered_of(&hash))
    }

    /// Averages the replicates, and renders those that are missing.
    pub fn average(&self) -> Result<Truth, Error> {
        check_memory(self.scene, &self.settings, self.settings.replicates)?;
        Ok(Truth::of(&self.replicates(0..self.settings.replicates)?)?)
    }

    /// Returns replicates by their indices. Reads those that are there; renders the others and writes each as soon as it is
    /// whole. Replaces a file that is broken or was made from other inputs.
    pub fn replicates(&self, indices: Range<u32>) -> Result<Vec<Replicate>, Error> {
        self.settings.check_truth(self.scene, self.alignment)?;
        let mut tracer = None;
        let own = std::slice::from_ref(self);
        let each = indices.map(|index| match self.read(index) {
            Some(found) => Ok(found),
            None => Ok(render_replicate(own, index, &mut tracer)?.remove(0)),
        });
        each.collect()
    }

    /// Tells whether the header of the truth's file names this many of these replicates.
    fn has_truth(&self, replicates: u32) -> bool {
        let found = read_attribute(&self.truth_path(), "content_hash");
        found == Some(truth_hash(&self.hash, replicates))
    }

    /// Reads a replicate; none where it is missing, broken or made from other inputs.
    fn read(&self, index: u32) -> Option<Replicate> {
        let found = Replicate::read(&self.path(index)).ok()?;
        let is_own = found.provenance.is_rendered_of(&self.hash) && found.index == index;
        is_own.then_some(found)
    }

    fn path(&self, index: u32) -> PathBuf {
        (self.folder).join(RenderFile::Replicate(self.alignment, index).path())
    }
}

/// Traces a replicate of each of several truths of one scene together, and writes each to its file. `tracer` is made for the first
/// replicate.
fn render_replicate<'a>(
    files: &[TruthFiles<'a>],
    index: u32,
    tracer: &mut Option<TruthTracer<'a>>,
) -> Result<Vec<Replicate>, Error> {
    let alignments: Vec<Alignment> = files.iter().map(|files| files.alignment).collect();
    let names: Vec<&str> = alignments.iter().map(|own| own.name()).collect();
    let TruthFiles {
        scene,
        settings,
        monitor,
        ..
    } = &files[0];
    let tracer = match tracer {
        Some(tracer) => tracer,
        none => none.insert(TruthTracer::new(scene, settings, &alignments)?),
    };
    let label = format!("{} {}, replicate {index}", scene.id, names.join(" and "));
    let replicates = monitor.watch(&label, |watch| tracer.trace(index, watch))?;
    for (files, replicate) in files.iter().zip(&replicates) {
        replicate.write(&files.path(index))?;
    }
    Ok(replicates)
}

const SHARED: [Alignment; 2] = [Alignment::Trailing, Alignment::Centred];

/// Renders those replicates that a trailing and a centred truth both lack, and writes them to `out`; does nothing unless
/// `alignments` holds both.
///
/// Where the two shutters overlap their samples are traced once. Both truths together take three quarters of the time of one
/// after the other, and have the same bytes.
pub fn render_shared(
    scene: &Scene,
    settings: &RenderSettings,
    alignments: &[Alignment],
    indices: Range<u32>,
    out: &Path,
    monitor: Monitor,
) -> Result<(), Error> {
    if !SHARED.iter().all(|shared| alignments.contains(shared)) {
        return Ok(());
    }
    let files = SHARED.map(|own| TruthFiles::new(scene, settings, own, out, monitor));
    if files.iter().any(|files| files.has_truth(indices.end)) {
        return Ok(());
    }
    for alignment in SHARED {
        settings.check_truth(scene, alignment)?;
    }
    // Each pair is written before the next is traced.
    check_memory(scene, settings, SHARED.len() as u32)?;
    let mut tracer = None;
    for index in indices {
        if files.iter().all(|files| files.read(index).is_none()) {
            render_replicate(&files, index, &mut tracer)?;
        }
    }
    Ok(())
}
