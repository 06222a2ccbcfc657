//! Lists of the scenes in a folder, and what each says about itself.

use std::io;

use super::error::SceneError;
use super::files::{Files, folder_name, read_document};
use super::variants::ParsedScene;
use crate::{Family, Location};

/// Description of a scene, without its meshes.
#[derive(Clone, Debug, serde::Serialize)]
pub struct SceneListing {
    /// Folder to load it from.
    #[serde(skip)]
    pub folder: Location,
    /// Name of the folder.
    pub name: String,
    /// Family, for leave-one-family-out cross-validation.
    pub family: Family,
    /// Sentence that says what the scene exposes.
    pub exposes: String,
    /// Names of the variants, in the order of the file.
    pub variants: Vec<String>,
}

/// Lists the scenes in `root` by name: every folder with a scene.toml. A folder without scenes is
/// an error.
pub fn list_scenes(root: impl Into<Location>) -> Result<Vec<SceneListing>, SceneError> {
    let root = root.into();
    let unreadable = |error| {
        let reason = format!("the folder of scenes cannot be read: {error}; name another folder");
        SceneError::in_file(&root.path, reason)
    };
    let mut folders = Vec::new();
    for folder in root.list().map_err(unreadable)? {
        if holds_scene(&folder)? {
            folders.push(folder);
        }
    }
    folders.sort_by(|a, b| a.path.cmp(&b.path));
    if folders.is_empty() {
        let reason = "holds no scene; a scene is a folder with a scene.toml";
        return Err(SceneError::in_file(&root.path, reason));
    }
    folders.iter().map(list_scene).collect()
}

/// Returns whether a folder has something named scene.toml. A folder that cannot be read is an
/// error: skipped silently, its scene would be missing from every mean.
fn holds_scene(location: &Location) -> Result<bool, SceneError> {
    let Some(folder) = location.on_disk() else {
        return Ok(location.join("scene.toml").is_file());
    };
    let unreadable = |error: io::Error| {
        let reason =
            format!("cannot be read: {error}; mend it, or move it out of the folder of scenes");
        SceneError::in_file(folder, reason)
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

/// Describes the scene in a folder.
pub fn list_scene(folder: impl Into<Location>) -> Result<SceneListing, SceneError> {
    let folder = folder.into();
    let document = read_document(&mut Files::new(&folder), &folder.path)?;
    let parsed = ParsedScene::parse(&document)?;
    let table = parsed.read(None)?;
    Ok(SceneListing {
        name: folder_name(&folder.path)?,
        family: table.family,
        exposes: table.exposes.0,
        variants: parsed.variant_names().to_vec(),
        folder,
    })
}
