//! Reader of JSON files that others may have written.

use frame::FileError;
use scene::Location;

/// Upper limit on the bytes of a baseline, bench.json, a journal and other files of numbers.
pub const MAX_JSON_BYTES: u64 = 1 << 28;

/// Upper limit on the bytes of run.json, and of its judgement.
pub const MAX_RUN_BYTES: u64 = 1 << 30;

/// Reads the text of a regular file of at most [`MAX_JSON_BYTES`].
///
/// # Errors
/// The file cannot be read, is larger, or is not UTF-8.
pub fn read_text(file: impl Into<Location>) -> Result<String, FileError> {
    read_text_within(file, MAX_JSON_BYTES)
}

/// Reads the text of a regular file of at most `most` bytes, with the same errors.
pub fn read_text_within(file: impl Into<Location>, most: u64) -> Result<String, FileError> {
    let file = file.into();
    String::from_utf8(file.read(most)?).map_err(|error| FileError::Foreign {
        path: file.path.clone(),
        reason: format!(
            "is no text: byte {} is not UTF-8; name a file that this program wrote",
            error.utf8_error().valid_up_to()
        ),
    })
}
