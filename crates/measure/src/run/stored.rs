//! A finished run in its folder.

use std::path::{Path, PathBuf};

use super::Run;
use super::case::Case;
use crate::Error;

/// A finished run and its path.
#[derive(Clone, Debug)]
pub struct StoredRun {
    /// Its run.json.
    pub path: PathBuf,
    /// The run.
    pub run: Run,
}

impl StoredRun {
    /// Reads a run.json, or the one in a folder.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let path = if path.is_dir() {
            path.join("run.json")
        } else {
            path.to_owned()
        };
        Ok(Self {
            run: Run::read(&path)?,
            path,
        })
    }

    /// Returns the folder above the run's pictures.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Returns the path of a file of a case.
    pub fn file(&self, case: &Case, name: &str) -> PathBuf {
        self.folder().join(&case.folder).join(name)
    }
}
