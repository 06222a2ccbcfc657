//! Captures of consecutive frames, in folders with their numbers.

use std::fs;
use std::path::{Path, PathBuf};

use frame::{FileError, Size, read_attribute};
use measure::Error;

use crate::capture::folder::{CONVENTION_FILE, Capture};
use crate::files::refuse;

/// Files that may hold velocity, in the order in which they are looked for.
const VELOCITY_FILES: [&str; 3] = ["velocity.exr", "buffers.exr", "color.exr"];
/// The velocity that leads to the frame before.
const PREVIOUS_FRAME: &str = "previous_frame";

/// Folders of consecutive frames.
pub struct Sequence {
    folder: PathBuf,
    /// Folders of the frames, in order.
    frames: Vec<PathBuf>,
    convention: Option<PathBuf>,
}

impl Sequence {
    /// Lists the frames of a folder: folders whose names are consecutive numbers.
    pub fn list(folder: &Path, convention: Option<&Path>) -> Result<Self, Error> {
        if !folder.is_dir() {
            return refuse!(
                folder,
                "there is no such folder; name one that holds a capture per frame: 0000, 0001 .."
            );
        }
        let mut numbers = list_numbers(folder)?;
        numbers.sort();
        if numbers.len() < 2 {
            let has = match numbers.len() {
                0 => "no frame",
                _ => "one frame",
            };
            return refuse!(
                folder,
                "holds {has}; velocity leads from one frame to the frame before: save two or more consecutive frames, each in a folder \
                 0000, 0001 .. with color.exr, velocity.exr and depth.exr"
            );
        }
        for pair in numbers.windows(2) {
            let [(one, _), (other, path)] = [&pair[0], &pair[1]];
            if *other != one + 1 {
                return refuse!(
                    path,
                    "follows frame {one}; allowed: consecutive frames, numbered without gaps"
                );
            }
        }
        Ok(Self {
            folder: folder.to_owned(),
            frames: numbers.into_iter().map(|(_, path)| path).collect(),
            convention: convention.map(Path::to_owned),
        })
    }

    /// Returns the number of frames.
    pub fn count(&self) -> usize {
        self.frames.len()
    }

    /// Names a frame by its folder.
    pub fn name(&self, index: usize) -> String {
        let name = self.frames[index].file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// Reads a frame; refuses one that lacks a buffer or has another velocity.
    pub fn read(&self, index: usize) -> Result<Capture, Error> {
        let folder = &self.frames[index];
        let shared = self.folder.join(CONVENTION_FILE);
        let has_shared = !folder.join(CONVENTION_FILE).is_file() && shared.is_file();
        let shared = has_shared.then_some(shared);
        let convention = self.convention.as_ref().or(shared.as_ref());
        let capture =
            Capture::read_of_sequence(folder, &self.folder, convention.map(|path| path.as_path()))?;
        capture.require_buffers()?;
        refuse_other_velocity(folder)?;
        Ok(capture)
    }
}

/// Refuses a frame of another size than the one before.
pub fn check_same_form(before: &Capture, after: &Capture) -> Result<(), Error> {
    let sizes: [Size; 2] = [before.color.size(), after.color.size()];
    if sizes[0] != sizes[1] {
        return refuse!(
            after.folder,
            "has {} pixels, the frame before {}; allowed: frames of one size",
            sizes[1],
            sizes[0]
        );
    }
    let has_ids = [before, after].map(|capture| capture.object_id.is_some());
    if has_ids[0] != has_ids[1] {
        let lacking = if has_ids[0] { after } else { before };
        return refuse!(
            lacking.folder.join("object.exr"),
            "there is no such file, but a frame beside it has one; save ids of all frames, or of none"
        );
    }
    Ok(())
}

/// Lists the folders whose names are numbers.
fn list_numbers(folder: &Path) -> Result<Vec<(u64, PathBuf)>, Error> {
    let fail = |source| FileError::io(folder, "read", source);
    let mut numbers = Vec::new();
    for entry in fs::read_dir(folder).map_err(fail)? {
        let path = entry.map_err(fail)?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.filter(|name| name.bytes().all(|byte| byte.is_ascii_digit()));
        let number = number.and_then(|name| name.parse().ok());
        numbers.extend(
            number
                .filter(|_| path.is_dir())
                .map(|number| (number, path)),
        );
    }
    Ok(numbers)
}

/// Refuses a file of this program that holds another velocity than the motion since the frame
/// before.
fn refuse_other_velocity(folder: &Path) -> Result<(), Error> {
    let paths = VELOCITY_FILES.map(|name| folder.join(name));
    let Some(path) = paths.iter().find(|path| path.is_file()) else {
        return Ok(());
    };
    match read_attribute(path, "velocity") {
        Some(kind) if kind != PREVIOUS_FRAME => refuse!(
            path,
            "holds the velocity {kind:?}; allowed: {PREVIOUS_FRAME:?}, the motion since the frame before: render with \
             --velocity {PREVIOUS_FRAME}"
        ),
        _ => Ok(()),
    }
}
