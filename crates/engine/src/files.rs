//! Files of a user, and those written for one.

use std::path::Path;

use frame::{FileError, write_atomically};
use serde::Serialize;
use suite::Error;

/// Refuses a file or a folder; the reason says what was found, and what is allowed.
pub fn refuse<T>(path: &Path, reason: &str) -> Result<T, Error> {
    Err(Error::Usage(format!("{}: {reason}", path.display())))
}

/// Writes plain data as JSON.
pub fn write_json(path: &Path, content: &impl Serialize) -> Result<(), FileError> {
    let text = serde_json::to_string_pretty(content).expect("plain data can be written") + "\n";
    write_atomically(path, text.as_bytes())
}
