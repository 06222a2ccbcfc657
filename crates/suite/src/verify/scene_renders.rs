//! The rendered files of a folder, scene by scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use frame::Alignment;
use store::{RenderFile, RenderPath, list_renders};
use tracer::SceneId;

use crate::Error;

/// The frame, truths, replicates and ladders of one scene, or of a later frame of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneRenders {
    /// Scene, of which the frame may be a later one.
    pub scene: SceneId,
    /// Folder of its files.
    pub folder: PathBuf,
    /// Name of this folder in messages: that in a pack, for files that were unpacked somewhere.
    pub shown: PathBuf,
    /// The files.
    pub files: BTreeSet<RenderFile>,
}

/// Lists the rendered files below a folder, which has the layout of a run's. Messages name files below `shown`.
///
/// # Errors
/// The folder cannot be read, or holds no frame and no truth.
pub fn list_scene_renders(root: &Path, shown: &Path) -> Result<Vec<SceneRenders>, Error> {
    let mut scenes: BTreeMap<SceneId, SceneRenders> = BTreeMap::new();
    for RenderPath { scene, file } in list_renders(root)? {
        let own = scenes
            .entry(scene)
            .or_insert_with_key(|scene| SceneRenders {
                scene: scene.clone(),
                folder: root.join(scene.folder()),
                shown: shown.join(scene.folder()),
                files: BTreeSet::new(),
            });
        own.files.insert(file);
    }
    match scenes.is_empty() {
        false => Ok(scenes.into_values().collect()),
        true => Err(Error::Usage(format!(
            "{}: holds no truth; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `render` wrote",
            shown.display()
        ))),
    }
}

impl SceneRenders {
    /// Lists the shutters of which a truth, replicates or a ladder are there.
    pub fn alignments(&self) -> BTreeSet<Alignment> {
        let files = self.files.iter();
        files.filter_map(|file| file.alignment()).collect()
    }

    /// Lists the replicates of a truth.
    pub(crate) fn replicates(&self, alignment: Alignment) -> BTreeSet<RenderFile> {
        let is_own =
            |file: &&RenderFile| matches!(file, RenderFile::Replicate(own, _) if *own == alignment);
        self.files.iter().filter(is_own).copied().collect()
    }

    /// Lists the rungs of a truth's ladder.
    pub(crate) fn rungs(&self, alignment: Alignment) -> Vec<RenderFile> {
        let is_own =
            |file: &&RenderFile| matches!(file, RenderFile::Rung(own, _) if *own == alignment);
        self.files.iter().filter(is_own).copied().collect()
    }
}
