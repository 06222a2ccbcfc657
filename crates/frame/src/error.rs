//! What can go wrong with a file.

use std::path::{Path, PathBuf};

/// A file that could not be read or written: the path comes first, then what was found and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The operating system refused.
    #[error("{path}: cannot {action}: {source}", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What was tried: `read`, `write`.
        action: &'static str,
        /// Why it failed.
        source: std::io::Error,
    },
    /// Not an OpenEXR file, or one cut short.
    #[error("{path}: not a complete OpenEXR file: {reason}; render it again", path = path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        reason: String,
    },
    /// A file that is not what is asked for: no regular file, too large, or an OpenEXR file without what it must hold.
    #[error("{path}: {reason}", path = path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What is missing or wrong, and what is allowed.
        reason: String,
    },
}

impl FileError {
    /// The operating system refused `action` (`read`, `write`).
    pub fn io(path: &Path, action: &'static str, source: std::io::Error) -> Self {
        Self::Io {
            path: path.to_owned(),
            action,
            source,
        }
    }
}
