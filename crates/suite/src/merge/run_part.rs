//! A finished run of some cases, to be joined with others.

use std::path::{Path, PathBuf};

use crate::Error;
use crate::run::Run;

/// A finished run, and the folder of its pictures.
pub(super) struct RunPart {
    /// Folder with `run.json`.
    pub folder: PathBuf,
    /// The run.
    pub run: Run,
}

impl RunPart {
    /// Reads a `run.json`, which is named itself or by its folder.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let file = match path.is_dir() {
            true => path.join("run.json"),
            false => path.to_owned(),
        };
        Ok(Self {
            run: Run::read(&file)?,
            folder: file.parent().unwrap_or(Path::new("")).to_owned(),
        })
    }

    /// Names its run.json.
    pub fn file(&self) -> String {
        self.folder.join("run.json").display().to_string()
    }
}
