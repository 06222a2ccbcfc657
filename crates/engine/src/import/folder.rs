//! Folders of an import.

use std::fs;
use std::path::Path;

use frame::FileError;

use suite::Error;

/// Makes a folder and those above it.
pub fn create(folder: &Path) -> Result<(), FileError> {
    fs::create_dir_all(folder).map_err(|source| FileError::io(folder, "create", source))
}

/// Refuses a folder that exists, or whose name no scene may have.
pub fn check_new(out: &Path) -> Result<(), Error> {
    if out.exists() {
        return Err(Error::Usage(format!(
            "{} exists already; name a folder that is new",
            out.display()
        )));
    }
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(allowed) {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{}: the folder's name becomes the scene's name; allowed are letters, digits, _ and -",
            out.display()
        ))),
    }
}
