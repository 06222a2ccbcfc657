//! Writing of files, whole or not at all.

use std::fs::OpenOptions;
use std::io::{BufWriter, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use super::error::FileError;
use super::reading::kind_of;

/// Beginning of the name of a file that is being written: `.shuttertruth-<any>.tmp`.
const PREFIX: &str = ".shuttertruth-";
/// End of that name.
const SUFFIX: &str = ".tmp";

/// Writes `bytes` under a temporary name in the same folder, then renames the file: the path has
/// all of them or its old content. Missing folders are made. The umask decides who may read the
/// file, as with every other program.
///
/// # Errors
/// Fails if the file cannot be written, or if a folder, a FIFO, a socket, a device or a link to one
/// is there: renaming would replace it, even `/dev/null`.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    write_streamed(path, |file| {
        (file.write_all(bytes)).map_err(|error| FileError::io(path, "write", error))
    })
}

/// Writes a file as [`write_atomically`] does, piece by piece: `write` writes the content. If it
/// fails, the path keeps its old content.
///
/// # Errors
/// Fails as [`write_atomically`] does, and if `write` fails.
pub fn write_streamed<E: From<FileError>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> Result<(), E> {
    let fail = |error| FileError::io(path, "write", error);
    refuse_to_replace(path)?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(fail)?;
    let mut temporary = BufWriter::new(create_temporary(folder).map_err(fail)?);
    write(&mut temporary)?;
    let temporary = temporary
        .into_inner()
        .map_err(|error| fail(error.into_error()))?;
    temporary.persist(path).map_err(|error| fail(error.error))?;
    Ok(())
}

fn refuse_to_replace(path: &Path) -> Result<(), FileError> {
    match std::fs::metadata(path) {
        // Renaming fails at a folder by itself.
        Ok(metadata) if !metadata.is_file() && !metadata.is_dir() => Err(FileError::foreign(
            path,
            format!(
                "is {}, where a file is to be written; name another file",
                kind_of(&metadata)
            ),
        )),
        _ => Ok(()),
    }
}

fn create_temporary(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let temporary = builder.tempfile_in(folder)?;
    // Locked while its writer lives, so that nobody takes it for a leftover. Some systems cannot
    // lock.
    let _ = temporary.as_file().try_lock();
    Ok(temporary)
}

/// Removes files that a process was writing into this folder when it was killed. Files that a
/// living process writes stay, and so do all other files and folders. Removes nothing beyond a link
/// to a folder.
pub fn remove_leftovers(folder: &Path) {
    if folder.is_symlink() {
        return;
    }
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_ours = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
        if !is_ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let file = OpenOptions::new().read(true).write(true).open(entry.path());
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            // A leftover that cannot be removed does no harm.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_device_or_a_socket_is_not_replaced() {
        use std::os::unix::fs::FileTypeExt;
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let _socket = std::os::unix::net::UnixListener::bind(path("socket")).unwrap();
        std::os::unix::fs::symlink("/dev/null", path("null")).unwrap();
        for (name, kind) in [("socket", "is a socket"), ("null", "is a device")] {
            let refusal = write_atomically(&path(name), b"text").unwrap_err();
            assert!(refusal.to_string().contains(kind), "{refusal}");
        }
        let socket = std::fs::symlink_metadata(path("socket")).unwrap();
        assert!(socket.file_type().is_socket());
        assert!(path("null").is_symlink());
    }

    #[cfg(unix)]
    #[test]
    fn nothing_beyond_a_link_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::create_dir(path("elsewhere")).unwrap();
        let dead = path("elsewhere/.shuttertruth-dead.tmp");
        std::fs::write(&dead, "").unwrap();
        std::os::unix::fs::symlink(path("elsewhere"), path("linked")).unwrap();
        remove_leftovers(&path("linked"));
        assert!(dead.exists());
        remove_leftovers(&path("elsewhere"));
        assert!(!dead.exists());
    }

    #[test]
    fn only_what_a_dead_process_was_writing_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let others = [".shuttertruth-notes", "frame.tmp", ".tmpAbCdEf"];
        for name in others {
            std::fs::write(path(name), "").unwrap();
        }
        std::fs::write(path(".shuttertruth-dead.tmp"), "").unwrap();
        std::fs::create_dir(path(".shuttertruth-folder.tmp")).unwrap();
        let living = create_temporary(folder.path()).unwrap();
        remove_leftovers(folder.path());
        assert!(!path(".shuttertruth-dead.tmp").exists());
        assert!(living.path().exists(), "it is being written");
        assert!(path(".shuttertruth-folder.tmp").exists());
        for name in others {
            assert!(path(name).exists(), "{name}");
        }
    }
}
