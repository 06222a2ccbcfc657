//! The replicates of a truth on disk: rendered one by one, each kept as soon as it is whole, found again, joined.

use std::ops::Range;
use std::path::{Path, PathBuf};

use frame::{Alignment, Replicate};
use tracer::{Scene, TruthSettings, TruthTracer};

use crate::{Error, Monitor};

/// Independent renders behind a truth.
pub const MOST_REPLICATES: u32 = 4096;

/// Where the replicates of one truth lie, and what they must have been made from.
pub struct Shelf {
    /// Folder of the scene's files.
    pub folder: PathBuf,
    /// Of the truth.
    pub alignment: Alignment,
    /// Content hash that every replicate must have.
    pub hash: String,
}

impl Shelf {
    /// The replicates of the truth that `settings` ask for, below a scene's folder.
    pub fn new(folder: PathBuf, scene: &Scene, settings: &TruthSettings) -> Self {
        Self {
            folder,
            alignment: settings.alignment,
            hash: tracer::replicate_hash(scene, settings),
        }
    }

    /// Where the truth lies that is made of the replicates.
    pub fn truth_path(&self) -> PathBuf {
        self.folder.join(format!("truth_{}.exr", self.alignment))
    }

    /// Where a replicate lies.
    pub fn path(&self, index: u32) -> PathBuf {
        replicates_folder(&self.folder, self.alignment).join(format!("replicate_{index:03}.exr"))
    }

    /// Replicates by their indices: those kept from before are read, the others rendered and kept, each as soon as it
    /// is whole. A file that is broken, or was made from other inputs, is replaced.
    pub fn obtain(
        &self,
        scene: &Scene,
        settings: &TruthSettings,
        indices: Range<u32>,
        monitor: Monitor,
    ) -> Result<Vec<Replicate>, Error> {
        let mut tracer = None;
        indices
            .map(|index| {
                if let Some(kept) = self.kept(index) {
                    return Ok(kept);
                }
                let tracer = match &mut tracer {
                    Some(tracer) => tracer,
                    none => none.insert(TruthTracer::new(scene, settings)?),
                };
                let label = format!("{} {}, replicate {index}", scene.name, self.alignment);
                let replicate = monitor.watch(&label, |watch| tracer.trace(index, watch))?;
                replicate.write(&self.path(index))?;
                Ok(replicate)
            })
            .collect()
    }

    fn kept(&self, index: u32) -> Option<Replicate> {
        let kept = Replicate::read(&self.path(index)).ok()?;
        (kept.provenance.content_hash == self.hash && kept.index == index).then_some(kept)
    }
}

/// Folder of the replicates behind `truth_<alignment>.exr`.
pub fn replicates_folder(scene_folder: &Path, alignment: Alignment) -> PathBuf {
    scene_folder.join(format!("truth_{alignment}"))
}
