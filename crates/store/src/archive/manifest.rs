//! The manifest of a pack: its first entry, which names every file with its size and its hashes.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::folder::is_below;
use crate::gather::MAX_TAKEN_BYTES;
use crate::render_file::{RenderFile, RenderPath};

/// Version of a pack's layout; it rises when a reader of the old layout would misread the new one.
pub const PACK_FORMAT: u32 = 1;
/// Name of the manifest in the archive.
pub(super) const MANIFEST: &str = "manifest.json";
/// Upper limit on the bytes of a manifest.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 26;
/// Upper limit on the bytes of a pack's files together, relative to the archive's. Rendered files are compressed already.
pub const LARGEST_PACK_RATIO: u64 = 64;

/// Fewest bytes of an archive per file: a file's hash and checksum alone take that many.
pub const LEAST_BYTES_PER_FILE: u64 = 64;

/// What a pack holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`PACK_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// The files, in the order of the archive: by path.
    pub files: Vec<PackedFile>,
}

/// A frame, a truth, a replicate of a truth, or a rung of its ladder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackedFile {
    /// Path below the folder of the run, with `/` between its parts: `fan/truth_trailing.exr`.
    pub path: String,
    /// Size in bytes.
    pub bytes: u64,
    /// BLAKE3 hash of these bytes, in hexadecimal.
    pub blake3: String,
    /// Hash of scene, settings and tracer, from the file's header; for a truth, the `truth_hash` of run.json.
    pub content_hash: String,
    /// Name of the scene, with its variant and its frame.
    pub scene: String,
    /// Columns, a frame's guard band included.
    pub width: u32,
    /// Rows, a frame's guard band included.
    pub height: u32,
    /// Mean samples per pixel of this file.
    pub samples_per_pixel: u32,
}

impl Manifest {
    /// Parses a manifest; the error says what is wrong with it, and what is allowed. `archive` is the size of the archive in bytes.
    pub(super) fn parse(bytes: &[u8], archive: u64) -> Result<Self, String> {
        let broken = |error: String| format!("{MANIFEST} is no manifest of a pack: {error}");
        let text = std::str::from_utf8(bytes).map_err(|error| broken(error.to_string()))?;
        check_format(text).map_err(broken)?;
        let manifest: Self =
            serde_json::from_str(text).map_err(|error| broken(error.to_string()))?;
        manifest.check(archive)?;
        Ok(manifest)
    }

    fn check(&self, archive: u64) -> Result<(), String> {
        if self.files.is_empty() {
            return Err(format!("{MANIFEST} names no file; a pack holds truths"));
        }
        let most = archive / LEAST_BYTES_PER_FILE;
        if self.files.len() as u64 > most {
            return Err(format!(
                "{MANIFEST} names {} files in an archive of {archive} bytes; allowed: up to {most}, one for each \
                 {LEAST_BYTES_PER_FILE} bytes",
                self.files.len()
            ));
        }
        for file in &self.files {
            check_path(&file.path)?;
            if file.bytes > MAX_TAKEN_BYTES {
                return Err(format!(
                    "{MANIFEST} says that {} has {} bytes; allowed: up to {MAX_TAKEN_BYTES}",
                    file.path, file.bytes
                ));
            }
        }
        let mut pairs = self
            .files
            .windows(2)
            .map(|pair| [&pair[0].path, &pair[1].path]);
        match pairs.find(|[one, next]| one >= next) {
            Some([one, next]) if one == next => {
                return Err(format!("{MANIFEST} names {one} twice"));
            }
            Some([one, next]) => {
                return Err(format!(
                    "{MANIFEST} names {next} after {one}; allowed: the order of paths"
                ));
            }
            None => {}
        }
        let total = self.bytes();
        if total / LARGEST_PACK_RATIO > archive {
            return Err(format!(
                "{MANIFEST} names {total} bytes of files in an archive of {archive}; allowed: {LARGEST_PACK_RATIO} times as many"
            ));
        }
        Ok(())
    }

    /// Returns the bytes of all files together.
    pub fn bytes(&self) -> u64 {
        let bytes = self.files.iter().map(|file| file.bytes);
        bytes.fold(0, u64::saturating_add)
    }

    /// Counts the truths.
    pub fn truths(&self) -> usize {
        let renders = self
            .files
            .iter()
            .filter_map(|file| RenderPath::parse(Path::new(&file.path)));
        let is_truth = |render: &RenderPath| matches!(render.file, RenderFile::Truth(_));
        renders.filter(is_truth).count()
    }
}

/// Reads the version alone: other versions have other keys.
fn check_format(text: &str) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Format {
        format: u32,
    }
    let Format { format } = serde_json::from_str(text).map_err(|error| error.to_string())?;
    match format == PACK_FORMAT {
        true => Ok(()),
        false => Err(format!(
            "it has format {format}; allowed: {PACK_FORMAT}; pack the run with this version of the program"
        )),
    }
}

/// Refuses a path that leaves the folder of the run, or that a system may read in two ways.
fn check_path(path: &str) -> Result<(), String> {
    let render = RenderPath::parse(Path::new(path)).filter(|render| render.to_string() == path);
    match render.is_some() && is_below(Path::new(path)) && !path.contains(['\\', ':']) {
        true => Ok(()),
        false => Err(format!(
            "{MANIFEST} names \"{path}\"; allowed: what a run renders, such as fan/frame.exr or fan/0001/truth_trailing.exr"
        )),
    }
}

#[test]
fn paths_that_leave_the_folder_and_files_that_no_run_renders_are_refused() {
    for path in [
        "../frame.exr",
        "fan/../../frame.exr",
        "/fan/frame.exr",
        "fan//frame.exr",
        "fan/./frame.exr",
        "./fan/frame.exr",
        "C:/fan/frame.exr",
        "C:/frame.exr",
        "fan\\frame.exr",
        "fan/\\frame.exr",
        "fan/frame.json",
    ] {
        assert!(check_path(path).is_err(), "{path}");
    }
    assert_eq!(check_path("fan/0001/ladder_centred/n64.exr"), Ok(()));
}
