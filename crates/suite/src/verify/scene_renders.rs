//! The rendered files of a folder, by scene.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use frame::Alignment;
use store::{RenderFile, RenderPath, list_renders};
use tracer::SceneId;

use crate::Error;

/// The frame, truths, replicates and ladders of one scene, or of one of its later frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneRenders {
    /// Scene, possibly at a later frame.
    pub scene: SceneId,
    /// Folder of its files.
    pub folder: PathBuf,
    /// Name of this folder in messages: the one in the pack, for unpacked files.
    pub shown: PathBuf,
    /// The files.
    pub files: BTreeSet<RenderFile>,
}

/// Lists the rendered files below a folder with the layout of a run's. Messages name files below `shown`.
pub fn list_scene_renders(root: &Path, shown: &Path) -> Result<Vec<SceneRenders>, Error> {
    let mut scenes: BTreeMap<SceneId, BTreeSet<RenderFile>> = BTreeMap::new();
    for RenderPath { scene, file } in list_renders(root)? {
        scenes.entry(scene).or_default().insert(file);
    }
    if scenes.is_empty() {
        return Err(Error::Usage(format!(
            "{}: holds no truth; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `render` wrote",
            shown.display()
        )));
    }
    let renders = scenes.into_iter().map(|(scene, files)| SceneRenders {
        folder: root.join(scene.folder()),
        shown: shown.join(scene.folder()),
        scene,
        files,
    });
    Ok(renders.collect())
}

impl SceneRenders {
    /// Lists the shutters with a truth, replicates or a ladder.
    pub fn alignments(&self) -> BTreeSet<Alignment> {
        let files = self.files.iter();
        files.filter_map(|file| file.alignment()).collect()
    }

    /// Lists the replicates of a truth, and the rungs of its ladder.
    pub(crate) fn of_truth(&self, alignment: Alignment) -> (Vec<RenderFile>, Vec<RenderFile>) {
        let files = (self.files.iter().copied())
            .filter(|file| file.alignment() == Some(alignment))
            .filter(|file| *file != RenderFile::Truth(alignment));
        files.partition(|file| matches!(file, RenderFile::Replicate(..)))
    }
}
