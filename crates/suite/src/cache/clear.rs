//! Removal of a scene's files, so that they are made anew.

use std::fs::{DirEntry, FileType};
use std::path::Path;

use frame::FileError;

use super::record::CASE_RECORD;
use crate::Error;

/// Removes frame, truths, replicates and ladders of a scene's folder, and the records of its cases. Refuses links to folders:
/// nothing outside is removed.
pub(crate) fn clear_scene(folder: &Path) -> Result<(), Error> {
    if let Ok(found) = std::fs::symlink_metadata(folder) {
        refuse_link(folder, found.file_type())?;
    }
    for entry in entries(folder)? {
        let kind =
            (entry.file_type()).map_err(|source| FileError::io(&entry.path(), "read", source))?;
        if kind.is_dir() || entry.path().is_dir() {
            refuse_link(&entry.path(), kind)?;
            for inner in entries(&entry.path())? {
                remove(&inner, is_part_or_case)?;
            }
        } else {
            remove(&entry, is_rendered)?;
        }
    }
    Ok(())
}

/// Tells whether a name is one such as `frame.exr`, `truth_trailing.exr`, or a record of these.
fn is_rendered(name: &str) -> bool {
    let is_one = |stem: &str| stem == "frame" || stem.starts_with("truth_");
    let stem = (name.strip_suffix(".exr")).or(name.strip_suffix(".json"));
    stem.is_some_and(is_one)
}

/// Tells whether a name is that of a case's record, of a replicate (`replicate_0.exr`) or of a ladder's rung (`n64.exr`).
fn is_part_or_case(name: &str) -> bool {
    let is_part = |stem: &str| {
        let number = stem.strip_prefix("replicate_").or(stem.strip_prefix('n'));
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    name == CASE_RECORD || name.strip_suffix(".exr").is_some_and(is_part)
}

/// Lists a folder; nothing where there is none.
fn entries(folder: &Path) -> Result<Vec<DirEntry>, FileError> {
    if !folder.exists() {
        return Ok(Vec::new());
    }
    let listed = std::fs::read_dir(folder).and_then(Iterator::collect);
    listed.map_err(|source| FileError::io(folder, "read", source))
}

fn remove(entry: &DirEntry, is_one: fn(&str) -> bool) -> Result<(), FileError> {
    match entry.file_name().to_str() {
        Some(name) if is_one(name) => std::fs::remove_file(entry.path())
            .map_err(|source| FileError::io(&entry.path(), "remove", source)),
        _ => Ok(()),
    }
}

fn refuse_link(path: &Path, kind: FileType) -> Result<(), Error> {
    match kind.is_symlink() {
        false => Ok(()),
        true => Err(Error::Usage(format!(
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
