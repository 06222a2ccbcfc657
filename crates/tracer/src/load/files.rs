//! The files that a scene is made from, read once each and hashed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{FileError, read_bounded};

/// Reads files and remembers what was in them.
pub(super) struct Files {
    folder: PathBuf,
    read: BTreeMap<String, blake3::Hash>,
}

impl Files {
    /// Files of the scene in `folder`.
    pub(super) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            read: BTreeMap::new(),
        }
    }

    /// The bytes of a regular file of at most `limit` bytes; the error is the reason alone, for the caller knows the
    /// place that names the file.
    pub(super) fn bytes(&mut self, path: &Path, limit: u64) -> Result<Vec<u8>, String> {
        let bytes = read_bounded(path, limit).map_err(reason)?;
        // Relative to the scene, so that a copy of the folder elsewhere has the same hash.
        let name = path.strip_prefix(&self.folder).unwrap_or(path);
        let name = name.to_string_lossy().replace('\\', "/");
        self.read.insert(name, blake3::hash(&bytes));
        Ok(bytes)
    }

    /// The text of such a file.
    pub(super) fn text(&mut self, path: &Path, limit: u64) -> Result<String, String> {
        String::from_utf8(self.bytes(path, limit)?).map_err(|_| "it is not UTF-8 text".to_owned())
    }

    /// Where the files lie that were read, in the order of their names.
    pub(super) fn paths(&self) -> Vec<PathBuf> {
        self.read
            .keys()
            .map(|name| self.folder.join(name))
            .collect()
    }

    /// One hash of the names and bytes of all files read and of the choice made, in hexadecimal.
    pub(super) fn hash(&self, variant: Option<&str>) -> String {
        let mut hasher = blake3::Hasher::new();
        for (name, hash) in &self.read {
            // A fixed-length hash ends each entry: no two lists of files run together.
            hasher.update(&(name.len() as u64).to_le_bytes());
            hasher.update(name.as_bytes());
            hasher.update(hash.as_bytes());
        }
        hasher.update(variant.unwrap_or("").as_bytes());
        hasher.finalize().to_hex().to_string()
    }
}

/// Why a file cannot be read, without its name.
pub(super) fn reason(error: FileError) -> String {
    match error {
        FileError::Io { source, .. } => source.to_string(),
        FileError::Foreign { reason, .. } => format!("it {reason}"),
        other => other.to_string(),
    }
}
