//! The kept renders of a folder.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use frame::Alignment;
use store::{RenderFile, RenderPath, list_renders};
use tracer::SceneId;

use crate::Error;

/// The kept frame, truths, replicates and ladders of one scene, or of a later frame of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptScene {
    /// Scene, of which the frame may be a later one.
    pub scene: SceneId,
    /// Folder of its files.
    pub folder: PathBuf,
    /// Name of this folder in messages: that in a pack, for files that were unpacked somewhere.
    pub shown: PathBuf,
    /// The files.
    pub files: BTreeSet<RenderFile>,
}

/// Lists the kept scenes below a folder, which has the layout of a run's. Messages name files below `shown`.
///
/// # Errors
/// The folder cannot be read, or holds no frame and no truth.
pub fn list_kept_scenes(root: &Path, shown: &Path) -> Result<Vec<KeptScene>, Error> {
    let mut kept: BTreeMap<SceneId, KeptScene> = BTreeMap::new();
    for RenderPath { scene, file } in list_renders(root)? {
        let own = kept.entry(scene).or_insert_with_key(|scene| KeptScene {
            scene: scene.clone(),
            folder: root.join(scene.folder()),
            shown: shown.join(scene.folder()),
            files: BTreeSet::new(),
        });
        own.files.insert(file);
    }
    match kept.is_empty() {
        false => Ok(kept.into_values().collect()),
        true => Err(Error::Usage(format!(
            "{}: holds no truth; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `render` wrote",
            shown.display()
        ))),
    }
}

impl KeptScene {
    /// Lists the shutters of which a truth, replicates or a ladder are there.
    pub fn alignments(&self) -> BTreeSet<Alignment> {
        self.files
            .iter()
            .filter_map(|file| file.alignment())
            .collect()
    }

    /// Lists the replicates of a truth by their indices.
    pub(crate) fn replicates(&self, alignment: Alignment) -> BTreeSet<u32> {
        let replicates = self.files.iter().filter_map(|file| match file {
            RenderFile::Replicate(own, index) if *own == alignment => Some(*index),
            _ => None,
        });
        replicates.collect()
    }

    /// Lists the rungs of a truth's ladder by their numbers of sub-frames.
    pub(crate) fn rungs(&self, alignment: Alignment) -> Vec<u32> {
        let rungs = self.files.iter().filter_map(|file| match file {
            RenderFile::Rung(own, subframes) if *own == alignment => Some(*subframes),
            _ => None,
        });
        rungs.collect()
    }
}
