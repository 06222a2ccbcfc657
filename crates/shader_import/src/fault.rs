//! Errors of shaders.

use std::path::{Path, PathBuf};

/// Error of importing a shader.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImportError {
    /// A fault in a file.
    #[error(transparent)]
    File(#[from] FileFault),
    /// The user interrupted the work.
    #[error("interrupted")]
    Interrupted,
}

/// Fault in a file of a filter's folder. The message names the place, what was found, what is
/// allowed, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}{}: {reason}", path.display(), after_colon(*line), after_colon(*column))]
pub struct FileFault {
    /// The file at fault, or the folder.
    pub path: PathBuf,
    /// Line in that file, from 1.
    pub line: Option<usize>,
    /// Column, from 1, if naga names one.
    pub column: Option<usize>,
    /// Fault, and what is allowed; naga adds the line itself and a mark below.
    pub reason: String,
}

impl FileFault {
    /// Makes the fault of a file, and of a line in it if it has one.
    pub fn new(path: &Path, line: impl Into<Option<usize>>, reason: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            line: line.into(),
            column: None,
            reason: reason.into(),
        }
    }
}

fn after_colon(number: Option<usize>) -> String {
    number.map_or(String::new(), |number| format!(":{number}"))
}
