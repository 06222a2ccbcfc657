//! Folder of a page that asks people: the page and its pictures.

use std::path::{Path, PathBuf};

use frame::{read_bounded, write_atomically};
use suite::{ClipFiles, Error, Question, Study};

use super::page::ask_page;

/// Name of the page in its folder.
pub const ASK_PAGE: &str = "index.html";

/// Writes the page of a study and copies of its pictures into a folder that is new or empty. Names of pictures tell no filter. Returns
/// the path of the page, which comes last.
///
/// # Errors
/// The folder holds files, or a picture cannot be copied.
pub fn write_ask_folder(
    study: &Study,
    clips: &[ClipFiles],
    questions: &[Question],
    out: &Path,
) -> Result<PathBuf, Error> {
    refuse_full(out)?;
    for (number, files) in clips.iter().enumerate() {
        for (frame, file) in files.iter().enumerate() {
            let picture = out.join("pictures").join(format!("{number}_{frame}.png"));
            write_atomically(&picture, &read_bounded(file, study.most_picture_bytes())?)?;
        }
    }
    let page = out.join(ASK_PAGE);
    write_atomically(&page, ask_page(study, questions).as_bytes())?;
    Ok(page)
}

/// Refuses a folder with files: pictures of another page would lie beside the new ones.
fn refuse_full(out: &Path) -> Result<(), Error> {
    let entries = match std::fs::read_dir(out) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(source) => return Err(frame::FileError::io(out, "write", source).into()),
    };
    match entries.count() {
        0 => Ok(()),
        count => Err(Error::Usage(format!(
            "{}: holds {count} files or folders; allowed: a new folder, or an empty one",
            out.display()
        ))),
    }
}
