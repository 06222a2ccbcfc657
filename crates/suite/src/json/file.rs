//! Files of JSON and of its lines, which others may have written.

use std::path::Path;

use frame::{FileError, read_bounded};

/// Bytes of run.json, of a baseline, of bench.json, of a journal and of the other files of numbers.
pub const MOST_JSON_BYTES: u64 = 1 << 28;

/// The text of a regular file of at most [`MOST_JSON_BYTES`].
///
/// # Errors
/// The file cannot be read, is larger, or holds something else than UTF-8.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read_bounded(path, MOST_JSON_BYTES)?).map_err(|error| FileError::Foreign {
        path: path.to_owned(),
        reason: format!(
            "is no text: byte {} is not UTF-8; name a file that this program wrote",
            error.utf8_error().valid_up_to()
        ),
    })
}
