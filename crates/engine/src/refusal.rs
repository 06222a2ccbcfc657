//! Refusals of files and folders.

use std::path::Path;

use suite::Error;

/// Refuses a file or a folder; the reason says what was found, and what is allowed.
pub fn refuse<T>(path: &Path, reason: &str) -> Result<T, Error> {
    Err(Error::Usage(format!("{}: {reason}", path.display())))
}
