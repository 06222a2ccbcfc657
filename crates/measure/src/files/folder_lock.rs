//! Lock of a process on the output folder that it writes to.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::ErrorKind;
use std::path::Path;

use frame::{FileError, remove_leftovers};
use scene::Scene;
use walkdir::WalkDir;

use crate::Error;
use crate::files::folder::{refuse_long_names, refuse_scene, scene_folder};

/// Name of the empty file that is locked; it stays in a folder that was locked once.
const LOCK_FILE: &str = ".shuttertruth.lock";

/// Other processes that may write to a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// None: run.json, a journal or cases are written.
    Alone,
    /// Those that render frames and truths: each file is written whole and identified by its
    /// content.
    Together,
}

/// A lock on a folder. The system releases it when the process ends, however it ends.
#[derive(Debug)]
#[must_use]
pub struct FolderLock {
    _lock: Option<File>,
}

/// Locks `out`, and makes it if it does not exist. Refuses a folder that contains one of the
/// scenes, one that another process has locked, and names of scenes that no folder can have. A
/// process that is alone removes what killed ones left half written.
pub fn lock_folder<'a>(
    out: &Path,
    scenes: impl IntoIterator<Item = &'a Scene>,
    sharing: Sharing,
) -> Result<FolderLock, Error> {
    let folders = (scenes.into_iter())
        .map(|scene| refuse_long_names(&scene.id.folder()).map(|()| scene_folder(out, scene)))
        .collect::<Result<Vec<_>, _>>()?;
    for folder in &folders {
        refuse_scene(folder)?;
    }
    refuse_file(out)?;
    std::fs::create_dir_all(out).map_err(|source| FileError::io(out, "write", source))?;
    let lock = FolderLock {
        _lock: lock(out, sharing)?,
    };
    if sharing == Sharing::Alone {
        remove_leftovers(out);
        for folder in &folders {
            remove_all_leftovers(folder);
        }
    }
    Ok(lock)
}

/// Refuses an output folder that is a file, or is below one.
fn refuse_file(out: &Path) -> Result<(), Error> {
    match out.ancestors().find(|path| path.is_file()) {
        None => Ok(()),
        Some(file) => Err(Error::Refused(format!(
            "{}: is a file, where the output folder is to be; name another output folder",
            file.display()
        ))),
    }
}

/// Locks the folder; none if the file system has no locks.
fn lock(out: &Path, sharing: Sharing) -> Result<Option<File>, Error> {
    let path = out.join(LOCK_FILE);
    let fail = |source: std::io::Error| -> Error {
        match source.kind() {
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => Error::Refused(format!(
                "{}: cannot write to this folder: {source}; name another output folder",
                out.display()
            )),
            _ => FileError::io(&path, "lock", source).into(),
        }
    };
    let mut options = OpenOptions::new();
    let file = (options.read(true).write(true).create(true).truncate(false))
        .open(&path)
        .map_err(fail)?;
    let locked = match sharing {
        Sharing::Alone => file.try_lock(),
        Sharing::Together => file.try_lock_shared(),
    };
    match locked {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(Error::Refused(format!(
            "another shuttertruth is writing to {}; wait until it has ended, or take another output folder",
            out.display()
        ))),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(None),
        Err(TryLockError::Error(error)) => Err(fail(error)),
    }
}

/// Removes leftovers in a scene's folder and in those below it: of later frames, and of cases and
/// replicates. Nothing beyond a link is ours.
fn remove_all_leftovers(folder: &Path) {
    if folder.is_symlink() {
        return;
    }
    remove_leftovers(folder);
    let entries = WalkDir::new(folder).min_depth(1).max_depth(2);
    for entry in entries.into_iter().flatten() {
        if entry.file_type().is_dir() {
            remove_leftovers(entry.path());
        }
    }
}
