//! A rendered file that is read again while its inputs stay the same.

use std::path::{Path, PathBuf};

use frame::FileError;
use tracer::Watch;

use crate::{Error, Monitor};

/// A rendered file: its place, its label in progress reports, and the hash of its inputs.
pub struct CachedFile {
    pub path: PathBuf,
    pub label: String,
    pub hash: String,
}

/// Functions that read a kind of file, write it, and return its content hash.
type Format<T> = (
    fn(&Path) -> Result<T, FileError>,
    fn(&T, &Path) -> Result<(), FileError>,
    fn(&T) -> &String,
);

impl CachedFile {
    /// Reads a file of the same content hash; renders and replaces any other.
    pub fn read_or_render<T>(
        &self,
        monitor: Monitor,
        render: impl FnOnce(Watch) -> Result<T, Error>,
        (read, write, hash): Format<T>,
    ) -> Result<T, Error> {
        if self.path.exists()
            && let Ok(found) = read(&self.path)
            && *hash(&found) == self.hash
        {
            return Ok(found);
        }
        let rendered = monitor.watch(&self.label, render)?;
        assert_eq!(
            *hash(&rendered),
            self.hash,
            "{}: the hash must not depend on the render",
            self.label
        );
        write(&rendered, &self.path)?;
        Ok(rendered)
    }
}
