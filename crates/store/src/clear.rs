//! Removal of a scene's files, so that they are made anew.

use std::ffi::OsStr;
use std::fs::{DirEntry, FileType};
use std::path::Path;

use frame::FileError;

use crate::Error;
use crate::record::CASE_RECORD;
use crate::render_file::RenderFile;

/// Removes frame, truths, replicates and ladders of a scene's folder, with the records of these and of its cases. Refuses links to
/// folders: nothing outside is removed.
///
/// # Errors
/// A folder is a link, or a file cannot be removed.
pub fn clear_scene(folder: &Path) -> Result<(), Error> {
    if let Ok(found) = std::fs::symlink_metadata(folder) {
        refuse_link(folder, found.file_type())?;
    }
    for entry in entries(folder)? {
        let path = entry.path();
        let kind = (entry.file_type()).map_err(|source| FileError::io(&path, "read", source))?;
        if kind.is_dir() || path.is_dir() {
            refuse_link(&path, kind)?;
            for inner in entries(&path)? {
                remove(folder, &inner.path())?;
            }
        } else {
            remove(folder, &path)?;
        }
    }
    Ok(())
}

/// Removes a file below a scene's folder if it is a rendered one, or a record.
fn remove(folder: &Path, path: &Path) -> Result<(), FileError> {
    let below = path.strip_prefix(folder).unwrap_or(path);
    let rendered = match below.extension() == Some(OsStr::new("json")) {
        true => below.with_extension("exr"),
        false => below.to_owned(),
    };
    match below.ends_with(CASE_RECORD) || RenderFile::parse(&rendered).is_some() {
        false => Ok(()),
        true => std::fs::remove_file(path).map_err(|source| FileError::io(path, "remove", source)),
    }
}

/// Lists a folder; nothing where there is none.
fn entries(folder: &Path) -> Result<Vec<DirEntry>, FileError> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let listed = std::fs::read_dir(folder).and_then(Iterator::collect);
    listed.map_err(|source| FileError::io(folder, "read", source))
}

fn refuse_link(path: &Path, kind: FileType) -> Result<(), Error> {
    match kind.is_symlink() {
        false => Ok(()),
        true => Err(Error::Refused(format!(
            "{} is a link, and nothing behind one is removed; remove the link, or take another output folder",
            path.display()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_would_be_read_back_are_removed_and_no_others() {
        let out = tempfile::tempdir().unwrap();
        let folder = out.path().join("fan");
        let gone = [
            "frame.exr",
            "frame.json",
            "truth_trailing.exr",
            "truth_trailing.json",
            "ladder_trailing/n64.exr",
            "truth_trailing/replicate_000.exr",
            "identity_default/case.json",
        ];
        let kept = [
            "frame.png",
            "notes.json",
            "identity_default/output.exr",
            "ladder_trailing/notes.exr",
        ];
        for name in gone.iter().chain(&kept) {
            let path = folder.join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "").unwrap();
        }
        clear_scene(&folder).unwrap();
        for name in gone {
            assert!(!folder.join(name).exists(), "{name}");
        }
        for name in kept {
            assert!(folder.join(name).exists(), "{name}");
        }
        clear_scene(&out.path().join("none")).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn nothing_behind_a_link_is_removed() {
        let out = tempfile::tempdir().unwrap();
        let mine = out.path().join("mine");
        std::fs::create_dir(&mine).unwrap();
        std::fs::write(mine.join("frame.exr"), "").unwrap();
        std::fs::write(mine.join("case.json"), "").unwrap();
        let linked = out.path().join("linked");
        std::os::unix::fs::symlink(&mine, &linked).unwrap();
        let inner = out.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        std::os::unix::fs::symlink(&mine, inner.join("identity_default")).unwrap();
        for folder in [linked, inner] {
            let refusal = clear_scene(&folder).unwrap_err().to_string();
            assert!(refusal.contains("is a link"), "{refusal}");
        }
        assert!(mine.join("frame.exr").exists() && mine.join("case.json").exists());
    }
}
