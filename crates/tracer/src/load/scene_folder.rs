//! The folder of a scene: its name and its scene.toml.

use std::path::Path;

use super::document::Document;
use super::error::{SceneError, check_visible};
use super::files::Files;
use crate::limits::LARGEST_SCENE_FILE;

/// Reads the scene.toml of a folder.
pub(super) fn read_document(files: &mut Files, folder: &Path) -> Result<Document, SceneError> {
    let path = folder.join("scene.toml");
    let text = files
        .read_text(&path, LARGEST_SCENE_FILE)
        .map_err(|error| {
            let reason = format!("cannot be read: {error}; a scene is a folder with a scene.toml");
            SceneError::in_file(&path, reason)
        })?;
    Ok(Document::new(&path, text))
}

/// Finds the name of a folder: the last part of its path, or of its full path if that ends in `.` or `..`.
pub(super) fn folder_name(folder: &Path) -> Result<String, SceneError> {
    let full = match folder.file_name() {
        Some(_) => folder.to_owned(),
        None => folder.canonicalize().unwrap_or_default(),
    };
    let name = full.file_name().unwrap_or_default().to_str();
    let checked = match name {
        Some(name) => check_visible(name).map(|()| name.to_owned()),
        None => Err("is not Unicode".to_owned()),
    };
    checked.map_err(|reason| {
        let reason =
            format!("the folder's name is the scene's, and it {reason}; rename the folder");
        SceneError::in_file(folder, reason)
    })
}
