//! Files from a user, and files for one.

use std::path::{Display, Path};

use frame::{FileError, write_atomically};
use serde::Serialize;

/// Refuses a file or a folder; the reason, a format and its values, names what was found and what
/// is allowed.
macro_rules! refuse {
    ($path:expr, $($reason:tt)*) => {
        Err(Error::Refused(format!("{}: {}", $path.display(), format_args!($($reason)*))))
    };
}
pub(crate) use refuse;

/// Returns the name of a file without its folder, for notes.
pub fn name_of(path: &Path) -> Display<'_> {
    Path::new(path.file_name().unwrap_or_default()).display()
}

/// Writes plain data as JSON.
pub fn write_json(path: &Path, content: &impl Serialize) -> Result<(), FileError> {
    let text = serde_json::to_string_pretty(content).expect("plain data can be written") + "\n";
    write_atomically(path, text.as_bytes())
}
