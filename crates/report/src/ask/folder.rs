//! Folder of a page for surveys: the page and its pictures.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use frame::{FileError, read_bounded, remove_leftovers, write_atomically};
use study::{ClipFiles, Question, Study};
use suite::Error;

use super::page::ask_page;

/// Name of the page in its folder.
pub const ASK_PAGE: &str = "index.html";

/// Name of the file that marks the folder until the page is complete.
const UNFINISHED: &str = ".shuttertruth.unfinished";

/// Writes the page of a study and copies of its pictures into a folder that is new or empty, or that a killed process was writing. The
/// pictures' names reveal no filter. Returns the path of the page, which is written last.
///
/// # Errors
/// The folder contains files, or a picture cannot be copied.
pub fn write_ask_folder(
    study: &Study,
    clips: &[ClipFiles],
    questions: &[Question],
    out: &Path,
) -> Result<PathBuf, Error> {
    remove_leftovers(out);
    let (pictures, unfinished) = (out.join("pictures"), out.join(UNFINISHED));
    match unfinished.is_file() {
        true => remove_pictures(&pictures)?,
        false => refuse_full(out)?,
    }
    write_atomically(&unfinished, b"")?;
    for (number, files) in clips.iter().enumerate() {
        for (frame, file) in files.iter().enumerate() {
            let picture = pictures.join(format!("{number}_{frame}.png"));
            write_atomically(&picture, &read_bounded(file, study.most_picture_bytes())?)?;
        }
    }
    let page = out.join(ASK_PAGE);
    write_atomically(&page, ask_page(study, questions).as_bytes())?;
    std::fs::remove_file(&unfinished)
        .map_err(|source| FileError::io(&unfinished, "remove", source))?;
    Ok(page)
}

/// Removes the pictures of an unfinished page: another study's would mix with the new ones.
fn remove_pictures(folder: &Path) -> Result<(), Error> {
    match std::fs::remove_dir_all(folder) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(FileError::io(folder, "remove", source).into())
        }
        _ => Ok(()),
    }
}

/// Refuses a folder with files: another page's pictures would mix with the new ones.
fn refuse_full(out: &Path) -> Result<(), Error> {
    let entries = match std::fs::read_dir(out) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(source) => return Err(FileError::io(out, "write", source).into()),
    };
    match entries.count() {
        0 => Ok(()),
        count => Err(Error::Usage(format!(
            "{}: holds {count} files or folders; allowed: a new folder, or an empty one",
            out.display()
        ))),
    }
}
