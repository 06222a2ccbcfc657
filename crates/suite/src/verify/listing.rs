//! The kept renders of a folder.

use std::path::{Path, PathBuf};

use frame::{Alignment, FileError};

use tracer::SceneId;

use crate::Error;
use crate::render::ladders::ladder_folder;
use crate::render::replicates::replicates_folder;

/// The kept frame, truths, replicates and ladders of one scene, or of a later frame of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeptScene {
    /// Scene, of which the frame may be a later one.
    pub scene: SceneId,
    /// Folder of its files.
    pub folder: PathBuf,
    /// Name of this folder in messages: that in a pack, for files that were unpacked somewhere.
    pub shown: PathBuf,
    /// Alignments of which a truth, replicates or a ladder lie there.
    pub alignments: Vec<Alignment>,
}

/// Lists the kept scenes below a folder, which has the layout of a run's: `fan/truth_trailing.exr`, `fan/0001/truth_trailing.exr`.
/// Looks nowhere else, and follows no links. Messages name files below `shown`.
///
/// # Errors
/// The folder cannot be read, or holds no frame and no truth.
pub fn list_kept_scenes(root: &Path, shown: &Path) -> Result<Vec<KeptScene>, Error> {
    let mut kept = Vec::new();
    for (scene, folder) in list_folders(root)? {
        let shown = shown.join(&scene);
        let Ok(id) = scene.parse::<SceneId>() else {
            continue;
        };
        let own = KeptScene::find(id, (&folder, &shown));
        let mut later: Vec<KeptScene> = list_folders(&folder)?
            .into_iter()
            .filter_map(|(name, folder)| {
                let id = format!("{scene}/{name}").parse().ok()?;
                KeptScene::find(id, (&folder, &shown.join(&name)))
            })
            .collect();
        later.sort_by_key(|kept| kept.scene.frame);
        kept.extend(own.into_iter().chain(later));
    }
    match kept.is_empty() {
        false => Ok(kept),
        true => Err(Error::Usage(format!(
            "{}: holds no truth; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `render` wrote",
            shown.display()
        ))),
    }
}

impl KeptScene {
    /// Finds what is kept in the folder of a scene; none where nothing of a render lies there.
    pub(crate) fn find(scene: SceneId, (folder, shown): (&Path, &Path)) -> Option<Self> {
        let has = |alignment: &Alignment| {
            folder.join(format!("truth_{alignment}.exr")).is_file()
                || replicates_folder(folder, *alignment).is_dir()
                || folder.join(ladder_folder(*alignment)).is_dir()
        };
        let alignments: Vec<Alignment> = Alignment::ALL.into_iter().filter(has).collect();
        (!alignments.is_empty() || folder.join("frame.exr").is_file()).then(|| Self {
            scene,
            folder: folder.to_owned(),
            shown: shown.to_owned(),
            alignments,
        })
    }
}

/// Lists the folders in a folder with their names, in the order of these.
fn list_folders(folder: &Path) -> Result<Vec<(String, PathBuf)>, Error> {
    let fail = |source| FileError::io(folder, "read", source);
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        let entry = entry.map_err(fail)?;
        if entry.file_type().map_err(fail)?.is_dir()
            && let Ok(name) = entry.file_name().into_string()
        {
            folders.push((name, entry.path()));
        }
    }
    folders.sort();
    Ok(folders)
}
