//! Files of the replicates of a truth.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

use frame::{Alignment, FileError, Replicate, Truth, read_attribute, truth_hash};
use tracer::{RenderSettings, Scene, TruthTracer};

use super::kept::is_rendered_of;
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
        self.folder.join(format!("truth_{}.exr", self.alignment))
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
            let tracer = match &mut tracer {
                Some(tracer) => tracer,
                none => none.insert(TruthTracer::new(scene, settings, &[self.alignment])?),
            };
            let label = format!("{} {}, replicate {index}", scene.id, self.alignment);
            for replicate in monitor.watch(&label, |watch| tracer.trace(index, watch))? {
                replicate.write(&self.path(index))?;
                replicates.push(replicate);
            }
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
        (found.ok()).filter(|found| is_rendered_of(&found.provenance, &hash))
    }

    /// Reads a replicate; none where it is missing, broken or made from other inputs.
    pub(super) fn read(&self, index: u32) -> Option<Replicate> {
        let found = Replicate::read(&self.path(index)).ok()?;
        let is_own = is_rendered_of(&found.provenance, &self.hash) && found.index == index;
        is_own.then_some(found)
    }

    /// Names the file of a replicate.
    pub(crate) fn path(&self, index: u32) -> PathBuf {
        replicates_folder(&self.folder, self.alignment).join(replicate_file(index))
    }

    /// Lists the replicates that are there and whose headers name these inputs: those that a render reads instead of tracing them.
    pub(crate) fn list_kept(&self) -> Result<BTreeSet<u32>, FileError> {
        let mut found = list_replicates(&self.folder, self.alignment)?;
        found.retain(|index| {
            read_attribute(&self.path(*index), "content_hash").as_ref() == Some(&self.hash)
        });
        Ok(found)
    }
}

/// Names the file of a replicate in its folder.
pub(crate) fn replicate_file(index: u32) -> String {
    format!("replicate_{index:03}.exr")
}

/// Lists the indices of the replicates of one alignment in a scene's folder, by their names.
pub(crate) fn list_replicates(
    scene_folder: &Path,
    alignment: Alignment,
) -> Result<BTreeSet<u32>, FileError> {
    let folder = replicates_folder(scene_folder, alignment);
    let fail = |source| FileError::io(&folder, "read", source);
    let mut indices = BTreeSet::new();
    for entry in std::fs::read_dir(&folder).map_err(fail)? {
        let name = entry.map_err(fail)?.file_name();
        indices.extend(replicate_index(&name.to_string_lossy()));
    }
    Ok(indices)
}

/// Returns the index of the replicate whose file has this name; none of other files.
pub(crate) fn replicate_index(file: &str) -> Option<u32> {
    let number = file.strip_prefix("replicate_")?.strip_suffix(".exr")?;
    let index = number.parse().ok()?;
    (replicate_file(index) == file).then_some(index)
}

/// Names the folder of the replicates behind `truth_<alignment>.exr`.
pub fn replicates_folder(scene_folder: &Path, alignment: Alignment) -> PathBuf {
    scene_folder.join(format!("truth_{alignment}"))
}
