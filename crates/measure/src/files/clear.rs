//! Removal of a scene's files, so that they are made anew.

use std::ffi::OsStr;
use std::path::Path;

use frame::{Alignment, FileError};
use walkdir::WalkDir;

use crate::Error;
use crate::files::folder::walk_error;
use crate::files::record::{CASE_RECORD, errors_file};
use crate::files::render_file::RenderFile;

/// Removes frame, truths, replicates and ladders from a scene's folder, with their records and its
/// cases' records. Refuses links to folders: nothing outside is removed.
///
/// # Errors
/// A folder is a link, or a file cannot be removed.
pub fn clear_scene(folder: &Path) -> Result<(), Error> {
    if !folder.exists() {
        return Ok(());
    }
    for entry in WalkDir::new(folder).max_depth(2) {
        let entry = entry.map_err(walk_error)?;
        let path = entry.path();
        if entry.depth() < 2 && entry.path_is_symlink() && path.is_dir() {
            return Err(Error::Refused(format!(
                "{} is a link, and nothing beyond one is removed; remove the link, or take another output folder",
                path.display()
            )));
        }
        if !entry.file_type().is_dir() && is_made(path.strip_prefix(folder).unwrap_or(path)) {
            std::fs::remove_file(path).map_err(|source| FileError::io(path, "remove", source))?;
        }
    }
    Ok(())
}

/// Returns whether a file below a scene's folder is a rendered one, or a record.
fn is_made(below: &Path) -> bool {
    let rendered = if below.extension() == Some(OsStr::new("json")) {
        below.with_extension("exr")
    } else {
        below.to_owned()
    };
    let is_errors = |alignment: &Alignment| below == Path::new(&errors_file(*alignment));
    below.ends_with(CASE_RECORD)
        || RenderFile::parse(&rendered).is_some()
        || Alignment::ALL.iter().any(is_errors)
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
            ".shuttertruth.errors_trailing.json",
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
