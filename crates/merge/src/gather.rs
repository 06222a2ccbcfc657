//! Files that one folder gets from others.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{FileError, read_bounded};
use measure::{Error, MAX_TAKEN_BYTES, is_one_file, place_file};

/// The source of each file, by its path below the parts.
pub type Files = BTreeMap<PathBuf, PathBuf>;

/// Gathers the files of several folders by their paths below each. Several may have the same file,
/// if its bytes are equal.
///
/// # Errors
/// Two files of one path differ, or a file cannot be read.
pub fn gather<'a>(
    parts: impl IntoIterator<Item = (&'a Path, Vec<PathBuf>)>,
) -> Result<Files, Error> {
    let mut files = Files::new();
    for (part, paths) in parts {
        for below in paths {
            let file = part.join(&below);
            match files.get(&below) {
                Some(other) => check_same(other, &file)?,
                None => drop(files.insert(below, file)),
            }
        }
    }
    Ok(files)
}

/// Refuses two files of one name with different bytes.
fn check_same(one: &Path, other: &Path) -> Result<(), Error> {
    let read = |path: &Path| read_bounded(path, MAX_TAKEN_BYTES);
    if is_one_file(one, other) || read(one)? == read(other)? {
        return Ok(());
    }
    Err(Error::Refused(format!(
        "{} and {} differ; all parts come from one build of the program, one version of the scenes, the same settings, and one kind of \
         processor",
        one.display(),
        other.display()
    )))
}

/// Places gathered files below a folder.
///
/// # Errors
/// A file is not a regular one, or cannot be read or written.
pub fn place_files(files: &Files, out: &Path) -> Result<(), FileError> {
    (files.iter()).try_for_each(|(below, file)| place_file(file, &out.join(below)))
}
