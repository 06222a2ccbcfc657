//! The scenes in a folder.

use std::io;
use std::path::{Path, PathBuf};

use super::error::SceneError;
use super::files::Files;
use super::variants::Parsed;
use super::{folder_name, read_document};
use crate::Family;

/// What a scene says about itself, meshes not loaded.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneListing {
    /// The folder to load it from.
    pub folder: PathBuf,
    /// The folder's name.
    pub name: String,
    /// For leave-one-family-out cross-validation.
    pub family: Family,
    /// What the scene exposes, in one sentence.
    pub exposes: String,
    /// Names of its variants, in the order of its file.
    pub variants: Vec<String>,
}

/// The scenes in `root`, by name: every folder in it that holds a scene.toml. Having none is an error.
pub fn list_scenes(root: &Path) -> Result<Vec<SceneListing>, SceneError> {
    let unreadable = |error| {
        SceneError::file(
            root,
            format!("the folder of scenes cannot be read: {error}"),
        )
    };
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(root).map_err(unreadable)? {
        let folder = entry.map_err(unreadable)?.path();
        if holds_scene(&folder)? {
            folders.push(folder);
        }
    }
    folders.sort();
    if folders.is_empty() {
        let reason = "holds no scene; a scene is a folder with a scene.toml";
        return Err(SceneError::file(root, reason));
    }
    folders.iter().map(|folder| list_scene(folder)).collect()
}

/// Whether something named scene.toml lies in a folder. What cannot be told is an error: a scene that is passed over in
/// silence is missing from every mean.
fn holds_scene(folder: &Path) -> Result<bool, SceneError> {
    let unreadable = |error: io::Error| {
        let reason =
            format!("cannot be read: {error}; mend it, or move it out of the folder of scenes");
        SceneError::file(folder, reason)
    };
    if !std::fs::metadata(folder).map_err(unreadable)?.is_dir() {
        return Ok(false);
    }
    match folder.join("scene.toml").symlink_metadata() {
        Ok(_) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(unreadable(error)),
    }
}

/// What the scene in a folder says about itself.
pub fn list_scene(folder: &Path) -> Result<SceneListing, SceneError> {
    let document = read_document(&mut Files::new(folder), folder)?;
    let parsed = Parsed::of(&document)?;
    let table = parsed.scene(None)?;
    Ok(SceneListing {
        folder: folder.to_owned(),
        name: folder_name(folder)?,
        family: table.family,
        exposes: table.exposes.into_inner(),
        variants: parsed.names().to_vec(),
    })
}
