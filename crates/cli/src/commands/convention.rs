//! Convention of an engine's files, as the command line names it.

use std::path::Path;

use filters::Convention;
use measure::{Error, read_text};

/// Reads an engine's convention, or the convention of frames if no file is named.
pub fn read_convention(path: Option<&Path>) -> Result<Convention, Error> {
    match path {
        None => Ok(Convention::default()),
        Some(path) => Ok(Convention::parse(path, &read_text(path)?)?),
    }
}
