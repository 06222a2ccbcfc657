//! Names of the files that are rendered, below the folder of a run.

use std::path::{Path, PathBuf};
use std::{fmt, fs};

use frame::{Alignment, FileError, read_attribute, rung_file};
use scene::SceneId;
use walkdir::{DirEntry, WalkDir};

use crate::files::folder::walk_error;
use crate::files::place::place_file;

/// Sub-frame counts of the ladder that N_eq is read from.
pub const LADDER: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Rung that is the sharp picture of a shutter's middle.
pub const SHARP: u32 = LADDER[0];
/// Upper limit on the replicates of a truth.
pub const MAX_REPLICATES: u32 = 4096;

/// A rendered file of one scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RenderFile {
    /// The frame of the instant.
    Frame,
    /// The truth of one shutter.
    Truth(Alignment),
    /// A replicate of a truth, by its index.
    Replicate(Alignment, u32),
    /// A rung of a truth's ladder, by its number of sub-frames.
    Rung(Alignment, u32),
}

impl RenderFile {
    /// Names the file in the folder of its scene.
    pub fn path(self) -> PathBuf {
        PathBuf::from(self.to_string())
    }

    /// Names the viewable picture of a frame or a truth, next to the file: `truth_trailing.png`.
    pub fn picture(self) -> String {
        self.to_string().replace(".exr", ".png")
    }

    /// Parses such a path; none for any other.
    pub fn parse(path: &Path) -> Option<Self> {
        let parts: Vec<&str> = path
            .iter()
            .map(|part| part.to_str())
            .collect::<Option<_>>()?;
        let stem = parts.last()?.strip_suffix(".exr")?;
        let file = match parts.as_slice() {
            ["frame.exr"] => Self::Frame,
            [_] => Self::Truth(stem.strip_prefix("truth_")?.parse().ok()?),
            [folder, _] => match folder.strip_prefix("ladder_") {
                Some(alignment) => Self::Rung(
                    alignment.parse().ok()?,
                    stem.strip_prefix('n')?.parse().ok()?,
                ),
                None => Self::Replicate(
                    folder.strip_prefix("truth_")?.parse().ok()?,
                    stem.strip_prefix("replicate_")?.parse().ok()?,
                ),
            },
            _ => return None,
        };
        let is_made = match file {
            Self::Replicate(_, index) => index < MAX_REPLICATES,
            Self::Rung(_, subframes) => LADDER.contains(&subframes),
            _ => true,
        };
        (is_made && file.path() == path).then_some(file)
    }

    /// Returns the index of a replicate, or the number of sub-frames of a rung; 0 for any other.
    pub fn number(self) -> u32 {
        match self {
            Self::Frame | Self::Truth(_) => 0,
            Self::Replicate(_, number) | Self::Rung(_, number) => number,
        }
    }

    /// Returns the shutter of a truth, a replicate or a rung.
    pub fn alignment(self) -> Option<Alignment> {
        match self {
            Self::Frame => None,
            Self::Truth(alignment) | Self::Replicate(alignment, _) | Self::Rung(alignment, _) => {
                Some(alignment)
            }
        }
    }
}

/// `truth_trailing/replicate_003.exr`
impl fmt::Display for RenderFile {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::Frame => f.write_str("frame.exr"),
            Self::Truth(alignment) => write!(f, "truth_{alignment}.exr"),
            Self::Replicate(alignment, index) => {
                write!(f, "truth_{alignment}/replicate_{index:03}.exr")
            }
            Self::Rung(alignment, subframes) => {
                write!(f, "{}/{}", ladder_folder(alignment), rung_file(subframes))
            }
        }
    }
}

/// A rendered file below the folder of a run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RenderPath {
    /// The scene, whose text names its folder: `fan` or `fan/0003`.
    pub scene: SceneId,
    /// The file.
    pub file: RenderFile,
}

impl RenderPath {
    /// Parses a path such as `fan/frame.exr` or `fan/0001/truth_trailing.exr`; none for any other.
    pub fn parse(below: &Path) -> Option<Self> {
        let mut parts = below.iter();
        let scene = parts.next()?.to_str()?;
        let file = parts.as_path();
        let number = parts.next()?.to_str()?;
        let (folder, file) = match number.parse::<u32>() {
            Ok(_) => (format!("{scene}/{number}"), parts.as_path()),
            Err(_) => (scene.to_owned(), file),
        };
        Some(Self {
            scene: folder.parse().ok()?,
            file: RenderFile::parse(file)?,
        })
    }

    /// Names the file below the folder of the run.
    pub fn path(&self) -> PathBuf {
        PathBuf::from(self.to_string())
    }
}

/// `fan/0003/truth_trailing.exr`, with `/` on every system, as an archive names it.
impl fmt::Display for RenderPath {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.scene, self.file)
    }
}

/// A requested rendered file of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Wanted {
    /// The file.
    pub file: RenderFile,
    /// Hash of its inputs, which its header must have.
    pub hash: String,
}

impl Wanted {
    /// Returns whether a scene's folder has it, by the header of the file.
    pub fn is_in(&self, folder: &Path) -> bool {
        let path = folder.join(self.file.path());
        read_attribute(&path, "content_hash").as_ref() == Some(&self.hash)
    }
}

/// Takes files that a scene's folder lacks from another folder of the scene that has them.
///
/// # Errors
/// A file cannot be taken.
pub(crate) fn take(files: &[Wanted], from: &Path, folder: &Path) -> Result<(), FileError> {
    for wanted in files {
        if !wanted.is_in(folder) && wanted.is_in(from) {
            let path = wanted.file.path();
            place_file(&from.join(&path), &folder.join(&path))?;
        }
    }
    Ok(())
}

/// Names the folder of the rungs of a ladder, in the folder of its scene.
pub fn ladder_folder(alignment: Alignment) -> String {
    format!("ladder_{alignment}")
}

/// Greatest depth of a file below a run's folder: in those of scene, later frame, and case or
/// replicates.
const DEPTH: usize = 4;

/// Lists the rendered files below a run's folder, by scene and frame. Looks nowhere else, and
/// follows no links.
///
/// # Errors
/// A folder cannot be read.
pub fn list_renders(root: &Path) -> Result<Vec<RenderPath>, FileError> {
    let files = list_files(root)?;
    let mut renders: Vec<RenderPath> = files
        .iter()
        .filter_map(|file| RenderPath::parse(file))
        .collect();
    renders.sort();
    Ok(renders)
}

/// Lists the files at most as deep below a run's folder as its own, except hidden ones: a killed
/// process may have left some. Follows no links.
///
/// # Errors
/// A folder cannot be read.
pub fn list_files(root: &Path) -> Result<Vec<PathBuf>, FileError> {
    // A walk of a file yields the file.
    fs::read_dir(root).map_err(|source| FileError::io(root, "read", source))?;
    let is_shown = |entry: &DirEntry| !entry.file_name().as_encoded_bytes().starts_with(b".");
    let entries = WalkDir::new(root).min_depth(1).max_depth(DEPTH);
    let mut files = Vec::new();
    for entry in entries
        .sort_by_file_name()
        .into_iter()
        .filter_entry(is_shown)
    {
        let entry = entry.map_err(walk_error)?;
        if entry.file_type().is_file() {
            let below = entry.path().strip_prefix(root).expect("it is below");
            files.push(below.to_owned());
        }
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_rendered_files_are_read_as_they_are_written() {
        for below in [
            "fan/frame.exr",
            "fan/0012/truth_trailing.exr",
            "fan@64px/truth_centred/replicate_1000.exr",
            "fan/ladder_leading/n64.exr",
        ] {
            let render = RenderPath::parse(Path::new(below)).expect(below);
            assert_eq!(render.to_string(), below);
        }
        for below in [
            "frame.exr",
            "fan/frame.json",
            "fan/other.exr",
            "fan/0001/0002/frame.exr",
            "fan/0000/frame.exr",
            "fan/truth_sideways.exr",
            "fan/truth_trailing/replicate_1.exr",
            "fan/truth_trailing/replicate_4096.exr",
            "fan/ladder_trailing/n3.exr",
            "",
        ] {
            assert_eq!(RenderPath::parse(Path::new(below)), None, "{below}");
        }
    }
}
