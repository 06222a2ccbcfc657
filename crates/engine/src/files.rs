//! Files from a user, and files for one.

use std::path::{Display, Path};

use frame::{FileError, write_atomically};
use measure::Error;
use serde::Serialize;

/// Refuses a file or a folder; the reason, a format and its values, names what was found and what
/// is allowed.
macro_rules! refuse {
    ($path:expr, $($reason:tt)*) => {
        Err($crate::files::refusal(&$path, format_args!($($reason)*)))
    };
}
pub(crate) use refuse;

/// Makes the error of a refused file or folder.
pub fn refusal(path: impl AsRef<Path>, reason: impl std::fmt::Display) -> Error {
    Error::Refused(format!("{}: {reason}", path.as_ref().display()))
}

/// Returns the name of a file without its folder, for notes.
pub fn name_of(path: &Path) -> Display<'_> {
    Path::new(path.file_name().unwrap_or_default()).display()
}

/// Writes plain data as JSON.
pub fn write_json(path: &Path, content: &impl Serialize) -> Result<(), FileError> {
    let text = serde_json::to_string_pretty(content).expect("plain data can be written") + "\n";
    write_atomically(path, text.as_bytes())
}
