//! The files that a scene is made from, read once each and hashed.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

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

    /// The bytes of a file.
    pub(super) fn bytes(&mut self, path: &Path) -> io::Result<Vec<u8>> {
        let bytes = std::fs::read(path)?;
        // Relative to the scene, so that a copy of the folder elsewhere has the same hash.
        let name = path.strip_prefix(&self.folder).unwrap_or(path);
        let name = name.to_string_lossy().replace('\\', "/");
        self.read.insert(name, blake3::hash(&bytes));
        Ok(bytes)
    }

    /// The text of a file.
    pub(super) fn text(&mut self, path: &Path) -> io::Result<String> {
        String::from_utf8(self.bytes(path)?)
            .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"))
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
