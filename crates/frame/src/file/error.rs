//! Errors of reading and writing files.

use std::path::{Path, PathBuf};

/// Error of a file. The message names the path, then what was found and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The operating system refused.
    #[error("{path}: cannot {action}: {source}", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Attempted action: `read`, `write`.
        action: &'static str,
        /// Message of the operating system.
        source: std::io::Error,
    },
    /// Not an OpenEXR file, or one cut short.
    #[error("{path}: not a complete OpenEXR file: {reason}; render it again", path = path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// Message of the decoder.
        reason: String,
    },
    /// Not the file that was asked for: not a regular file, too large, or an OpenEXR file that
    /// lacks required content.
    #[error("{path}: {reason}", path = path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// Fault, and what is allowed.
        reason: String,
    },
}

impl FileError {
    /// Makes an error of an `action` (`read`, `write`) that the operating system refused.
    pub fn io(path: &Path, action: &'static str, source: std::io::Error) -> Self {
        Self::Io {
            path: path.to_owned(),
            action,
            source,
        }
    }

    /// Returns the fault without the path, for messages that name the file otherwise.
    pub fn reason(self) -> String {
        match self {
            Self::Broken { reason, .. } => format!("not a complete OpenEXR file: {reason}"),
            Self::Foreign { reason, .. } => reason,
            error @ Self::Io { .. } => error.to_string(),
        }
    }

    /// Makes an error of a file that is not the one asked for.
    pub fn foreign(path: &Path, reason: String) -> Self {
        Self::Foreign {
            path: path.to_owned(),
            reason,
        }
    }
}
