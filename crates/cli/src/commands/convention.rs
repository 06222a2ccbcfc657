//! Reader of the file that `--convention` names.

use std::path::Path;

use filters::Convention;
use store::read_text;
use suite::Error;

/// Reads the convention of an engine; that of frames if no file is named.
pub fn read_convention(path: Option<&Path>) -> Result<Convention, Error> {
    match path {
        None => Ok(Convention::default()),
        Some(path) => Ok(Convention::parse(path, &read_text(path)?)?),
    }
}
