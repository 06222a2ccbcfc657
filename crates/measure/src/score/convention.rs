//! Convention of an engine's files.

use std::path::Path;

use crate::{Error, read_text};
use filters::Convention;

/// Reads an engine's convention, or the convention of frames if no file is named.
///
/// # Errors
/// The file cannot be read, or has no valid table `[convention]`.
pub fn read_convention(path: Option<&Path>) -> Result<Convention, Error> {
    match path {
        None => Ok(Convention::default()),
        Some(path) => Ok(Convention::parse(path, &read_text(path)?)?),
    }
}
