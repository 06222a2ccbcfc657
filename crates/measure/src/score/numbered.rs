//! Numbered pictures in a folder, one per frame of a sequence.

use std::path::{Path, PathBuf};

use crate::{Error, printable_path};

/// Endings of pictures that can be scored.
const ENDINGS: [&str; 2] = ["exr", "png"];

/// Names the picture of a frame in a folder of numbered pictures: `0003.exr`.
pub fn numbered_file(folder: &Path, frame: u32) -> PathBuf {
    folder.join(format!("{frame:04}.exr"))
}

/// Finds the picture of each frame in a folder of numbered pictures, from `0000.exr` or `0000.png`
/// on.
///
/// # Errors
/// A picture is missing, or one frame has two.
pub fn find_numbered(folder: &Path, frames: u32) -> Result<Vec<PathBuf>, Error> {
    if !folder.is_dir() {
        return Err(Error::Refused(format!(
            "{}: is no folder; needed: a folder of pictures 0000.exr, 0001.exr and so on, one per frame",
            printable_path(folder)
        )));
    }
    let all = (0..frames).map(|frame| {
        let exr = numbered_file(folder, frame);
        let both = ENDINGS.map(|ending| exr.with_extension(ending));
        let files: Vec<&PathBuf> = both.iter().filter(|path| path.is_file()).collect();
        match files.as_slice() {
            [one] => Ok((*one).clone()),
            [] => Err(Error::Refused(format!(
                "{}: there is no such file, nor a PNG; needed: one picture for each of the {frames} frames, numbered from 0000",
                printable_path(&exr)
            ))),
            _ => Err(Error::Refused(format!(
                "{} and {}: both are the picture of one frame; remove one of them",
                printable_path(&both[0]),
                printable_path(&both[1])
            ))),
        }
    });
    all.collect()
}
