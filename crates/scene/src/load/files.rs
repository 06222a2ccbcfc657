//! The folder of a scene, and the files that it is made of, each with the hash of its bytes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::FileError;

use super::document::Document;
use super::error::{SceneError, check_visible};
use crate::Location;
use crate::limits::LARGEST_SCENE_FILE;

/// Files of a scene that have been read.
pub(super) struct Files {
    folder: Location,
    /// Hashes by name, relative to the folder.
    hashes: BTreeMap<String, blake3::Hash>,
}

impl Files {
    /// Starts with no files of the scene in `folder`.
    pub(super) fn new(folder: &Location) -> Self {
        Self {
            folder: folder.clone(),
            hashes: BTreeMap::new(),
        }
    }

    /// Reads a regular file of at most `limit` bytes. The error is a reason alone: the caller knows
    /// the line that names the file.
    pub(super) fn read(&mut self, path: &Path, limit: u64) -> Result<Vec<u8>, String> {
        let bytes = self.folder.at(path).read(limit).map_err(describe)?;
        // Relative to the scene, so that a copy of the folder elsewhere has the same hash.
        let name = path.strip_prefix(&self.folder.path).unwrap_or(path);
        let name = name.to_string_lossy().replace('\\', "/");
        self.hashes.insert(name, blake3::hash(&bytes));
        Ok(bytes)
    }

    /// Reads a file of UTF-8 text.
    pub(super) fn read_text(&mut self, path: &Path, limit: u64) -> Result<String, String> {
        String::from_utf8(self.read(path, limit)?).map_err(|_| "it is not UTF-8 text".to_owned())
    }

    /// Paths of the files read, in the order of their names.
    pub(super) fn paths(&self) -> Vec<PathBuf> {
        self.hashes
            .keys()
            .map(|name| self.folder.path.join(name))
            .collect()
    }

    /// Hash of the names and bytes of all files read and of the variant chosen, in hexadecimal.
    pub(super) fn hash(&self, variant: Option<&str>) -> String {
        let mut hasher = blake3::Hasher::new();
        for (name, hash) in &self.hashes {
            // Lengths and fixed-size hashes keep entries apart.
            hasher.update(&(name.len() as u64).to_le_bytes());
            hasher.update(name.as_bytes());
            hasher.update(hash.as_bytes());
        }
        hasher.update(variant.unwrap_or("").as_bytes());
        hasher.finalize().to_hex().to_string()
    }
}

/// Says why a file cannot be read, without its name.
fn describe(error: FileError) -> String {
    match error {
        FileError::Io { source, .. } => source.to_string(),
        FileError::Foreign { reason, .. } => format!("it {reason}"),
        other => other.to_string(),
    }
}

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

/// Finds the name of a folder: the last part of its path, or of its full path if that ends in `.`
/// or `..`.
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
