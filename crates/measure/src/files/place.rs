//! A file that one folder gets from another.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use frame::{FileError, read_bounded, write_atomically};
use same_file::is_same_file;

/// Upper limit on the bytes of a file that is taken from another folder.
pub const MAX_TAKEN_BYTES: u64 = 1 << 32;

/// Returns whether two paths lead to one regular file. Others are not opened: a FIFO would block.
pub fn is_one_file(one: &Path, other: &Path) -> bool {
    one.is_file() && other.is_file() && is_same_file(one, other).is_ok_and(|same| same)
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
