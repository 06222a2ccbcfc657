//! The folder of a scene's files, below an output folder.

use std::path::{Component, Path, PathBuf};

use frame::{FileError, is_hidden};
use scene::Scene;

use crate::Error;

/// Upper limit on the bytes of a folder's name, of a scene or a case. File systems allow 255, and
/// some names of files add an ending to it.
pub const LONGEST_FOLDER_NAME: usize = 240;
/// Number of characters of a too long name that an error shows.
const SHOWN: usize = 40;

/// Names the folder of a scene's files below `out`.
pub fn scene_folder(out: &Path, scene: &Scene) -> PathBuf {
    out.join(scene.id.folder())
}

/// Refuses a folder that contains a scene: our pictures may have the names of its textures.
pub fn refuse_scene(folder: &Path) -> Result<(), Error> {
    if folder.join("scene.toml").exists() {
        Err(Error::Refused(format!(
            "{} holds a scene, and its files would be overwritten; allowed: an output folder that holds none, such as out",
            folder.display()
        )))
    } else {
        Ok(())
    }
}

/// Refuses a path with a folder name that is too long for file systems.
pub fn refuse_long_names(folders: &Path) -> Result<(), Error> {
    let names = folders.iter().map(|name| name.to_string_lossy());
    match names.max_by_key(|name| name.len()) {
        Some(name) if name.len() > LONGEST_FOLDER_NAME => Err(Error::Refused(format!(
            "the output folder \"{}...\" would have a name of {} bytes; allowed: up to {LONGEST_FOLDER_NAME}; it is made of the names of \
             scene and variant, or of filter, preset and overrides: give them shorter ones",
            name.chars().take(SHOWN).collect::<String>(),
            name.len()
        ))),
        _ => Ok(()),
    }
}

/// Names the folder that a walk of folders cannot read.
pub(crate) fn walk_error(error: walkdir::Error) -> FileError {
    let path = error.path().unwrap_or(Path::new("")).to_owned();
    let source = error.into_io_error();
    FileError::io(&path, "read", source.expect("links are not followed"))
}

/// Returns whether a path stays below its first folder and has no control characters. Nothing is
/// read or written elsewhere.
pub fn is_below(path: &Path) -> bool {
    let mut parts = path.components().peekable();
    parts.peek().is_some()
        && parts.all(|part| matches!(part, Component::Normal(_)))
        && !path.to_string_lossy().contains(is_hidden)
}
