//! Folder and scene of a capture, as the command line names them.

use std::path::{Path, PathBuf};

use measure::Error;
use scene::{Location, Scene};
use terminal::refuse;
use terminal::selection::select_scenes;

/// Names the folder to write: the given one, or one below a default with the capture's name.
pub fn name_folder(capture: &Path, out: Option<&PathBuf>, below: &str) -> Result<PathBuf, Error> {
    let capture =
        (capture.canonicalize()).map_err(|source| frame::FileError::io(capture, "read", source))?;
    Ok(match out {
        Some(out) => out.clone(),
        None => Path::new(below).join(capture.file_name().unwrap_or(capture.as_os_str())),
    })
}

/// Loads the one scene that an engine drew.
pub fn load_drawn_scene(scenes: &Location, name: &str) -> Result<Scene, Error> {
    let mut choices = select_scenes(scenes, &[name.to_owned()])?;
    match choices.len() {
        1 => Ok(choices.remove(0).scene),
        count => refuse!("scene {name}: matches {count} scenes; a capture shows one"),
    }
}
