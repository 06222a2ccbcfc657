//! Files that one folder gets from others.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use frame::{FileError, read_bounded, write_atomically};
use same_file::is_same_file;

use crate::Error;

/// Upper limit on the bytes of a file that is taken from another folder.
pub const MAX_TAKEN_BYTES: u64 = 1 << 32;

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

/// Returns whether two paths lead to one regular file. Others are not opened: a FIFO would block.
fn is_one_file(one: &Path, other: &Path) -> bool {
    one.is_file() && other.is_file() && is_same_file(one, other).is_ok_and(|same| same)
}

/// Places gathered files below a folder.
///
/// # Errors
/// A file is not a regular one, or cannot be read or written.
pub fn place_files(files: &Files, out: &Path) -> Result<(), FileError> {
    (files.iter()).try_for_each(|(below, file)| place_file(file, &out.join(below)))
}

/// Links the file `from` at `to`, replacing any file there, or copies it if the file system has no
/// hard links. This program replaces files as a whole, so neither name changes the other.
///
/// # Errors
/// Fails if `from` is not a regular file, if `to` is a folder, or if a file cannot be read or
/// written.
pub fn place_file(from: &Path, to: &Path) -> Result<(), FileError> {
    let metadata =
        fs::symlink_metadata(from).map_err(|source| FileError::io(from, "read", source))?;
    if !metadata.is_file() {
        return Err(FileError::Foreign {
            path: from.to_owned(),
            reason: "is no regular file; allowed: files as this program writes them".to_owned(),
        });
    }
    if is_one_file(from, to) {
        return Ok(());
    }
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder).map_err(|source| FileError::io(folder, "write", source))?;
    }
    if let Err(source) = fs::remove_file(to)
        && source.kind() != ErrorKind::NotFound
    {
        return Err(FileError::io(to, "write", source));
    }
    match fs::hard_link(from, to) {
        Ok(()) => Ok(()),
        // Another disk, or a system without hard links.
        Err(_) => write_atomically(to, &read_bounded(from, MAX_TAKEN_BYTES)?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_placed_file_replaces_another_and_outlives_a_change_of_its_source() {
        let folder = tempfile::tempdir().unwrap();
        let [from, to] = ["a.exr", "below/b.exr"].map(|name| folder.path().join(name));
        fs::write(&from, "one").unwrap();
        place_file(&from, &to).unwrap();
        place_file(&from, &to).unwrap();
        assert_eq!(fs::read(&to).unwrap(), b"one");
        write_atomically(&from, b"two").unwrap();
        assert_eq!(fs::read(&to).unwrap(), b"one");
        place_file(&from, &to).unwrap();
        assert_eq!(fs::read(&to).unwrap(), b"two");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_no_file_to_take() {
        let folder = tempfile::tempdir().unwrap();
        let [secret, link, to] = ["secret", "link", "to"].map(|name| folder.path().join(name));
        fs::write(&secret, "mine").unwrap();
        std::os::unix::fs::symlink(&secret, &link).unwrap();
        let refusal = place_file(&link, &to).unwrap_err().to_string();
        assert!(refusal.contains("no regular file"), "{refusal}");
        assert!(!to.exists());
    }
}
