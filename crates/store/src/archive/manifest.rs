//! The manifest of a pack: its first entry, which names every file with its size and its hashes.

use std::path::{Component, Path};

use serde::{Deserialize, Serialize};

use crate::gather::MOST_TAKEN_BYTES;
use crate::json_strings::check_strings;
use crate::render_file::RenderPath;

/// Version of the layout of a pack; it rises when a reader of the old one would misread the new one.
pub const PACK_FORMAT: u32 = 1;
/// Name of the manifest in the archive.
pub(super) const MANIFEST: &str = "manifest.json";
/// Upper limit on the bytes of a manifest.
pub const MOST_MANIFEST_BYTES: u64 = 1 << 26;
/// Upper limit on the bytes of all files of a pack, relative to those of the archive. Kept files are compressed already.
pub const LARGEST_PACK_RATIO: u64 = 64;

/// Least bytes of an archive for each of its files: its hash and its checksum alone take as many.
pub const LEAST_BYTES_PER_FILE: u64 = 64;

/// What a pack holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`PACK_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// The files, in the order of the archive: that of their paths.
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
    /// Hash of scene, settings and tracer, as the file's header has it; that of a truth is the `truth_hash` of run.json.
    pub content_hash: String,
    /// Name of the scene, with its variant and its frame.
    pub scene: String,
    /// Columns, with the guard band of a frame.
    pub width: u32,
    /// Rows, with the guard band of a frame.
    pub height: u32,
    /// Mean samples per pixel of this file.
    pub samples_per_pixel: u32,
}

impl Manifest {
    /// Parses a manifest; the error says what is wrong with it, and what is allowed. `archive` is the size of the archive in bytes.
    pub(super) fn parse(bytes: &[u8], archive: u64) -> Result<Self, String> {
        let broken = |error: String| format!("{MANIFEST} is no manifest of a pack: {error}");
        let text = std::str::from_utf8(bytes).map_err(|error| broken(error.to_string()))?;
        check_strings(text).map_err(|error| broken(error.to_string()))?;
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
            if file.bytes > MOST_TAKEN_BYTES {
                return Err(format!(
                    "{MANIFEST} says that {} has {} bytes; allowed: up to {MOST_TAKEN_BYTES}",
                    file.path, file.bytes
                ));
            }
        }
        for pair in self.files.windows(2) {
            match pair[0].path.cmp(&pair[1].path) {
                std::cmp::Ordering::Less => {}
                std::cmp::Ordering::Equal => {
                    return Err(format!("{MANIFEST} names {} twice", pair[0].path));
                }
                std::cmp::Ordering::Greater => {
                    return Err(format!(
                        "{MANIFEST} names {} behind {}; allowed: the order of paths",
                        pair[1].path, pair[0].path
                    ));
                }
            }
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
        let names = self.files.iter().map(|file| file.path.rsplit('/').next());
        names
            .filter(|name| name.is_some_and(|name| name.starts_with("truth_")))
            .count()
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
    let parts = Path::new(path).components();
    let is_plain = parts
        .map(|part| match part {
            Component::Normal(part) => part.to_str(),
            _ => None,
        })
        .collect::<Option<Vec<_>>>()
        .is_some_and(|parts| parts.join("/") == path);
    match is_plain && !path.contains(['\\', ':']) && RenderPath::parse(Path::new(path)).is_some() {
        true => Ok(()),
        false => Err(format!(
            "{MANIFEST} names \"{path}\"; allowed: what a run renders, such as fan/frame.exr or fan/0001/truth_trailing.exr"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(paths: &[&str]) -> Manifest {
        Manifest {
            format: PACK_FORMAT,
            program: "test".to_owned(),
            files: (paths.iter())
                .map(|path| PackedFile {
                    path: (*path).to_owned(),
                    bytes: 10,
                    blake3: String::new(),
                    content_hash: String::new(),
                    scene: "fan".to_owned(),
                    width: 16,
                    height: 16,
                    samples_per_pixel: 8,
                })
                .collect(),
        }
    }

    #[test]
    fn more_files_than_an_archive_has_room_for_are_refused() {
        let file = |index: u32| format!("fan/truth_centred/replicate_{index:03}.exr");
        let paths: Vec<String> = (0..16).map(file).collect();
        let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
        let refusal = parse(&manifest(&paths)).unwrap_err();
        let found = "16 files in an archive of 1000 bytes; allowed: up to 15";
        assert!(refusal.contains(found), "{refusal}");
        assert!(parse(&manifest(&paths[1..])).is_ok());
    }

    fn parse(manifest: &Manifest) -> Result<Manifest, String> {
        Manifest::parse(&serde_json::to_vec(manifest).unwrap(), 1000)
    }

    #[test]
    fn a_manifest_is_read_as_it_was_written() {
        let whole = manifest(&[
            "fan/0001/ladder_centred/n64.exr",
            "fan/frame.exr",
            "fan/truth_trailing.exr",
            "fan/truth_trailing/replicate_000.exr",
        ]);
        assert_eq!(parse(&whole), Ok(whole));
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
            "fan\\frame.exr",
            "fan/\\frame.exr",
            "frame.exr",
            "fan/frame.json",
            "fan/other.exr",
            "fan/0001/0002/frame.exr",
            "fan/truth_sideways.exr",
            "fan/truth_trailing/replicate_1.exr",
            "fan/truth_trailing/frame.exr",
            "fan/ladder_trailing/n3.exr",
            "",
        ] {
            let refusal = parse(&manifest(&[path])).unwrap_err();
            assert!(refusal.contains("allowed: what a run renders"), "{refusal}");
        }
    }

    #[test]
    fn twins_and_another_order_are_refused() {
        let refusal = |paths: &[&str]| parse(&manifest(paths)).unwrap_err();
        let [a, b] = ["a/frame.exr", "b/frame.exr"];
        assert!(refusal(&[a, a]).contains("names a/frame.exr twice"));
        assert!(refusal(&[b, a]).contains("the order of paths"));
        assert!(refusal(&[]).contains("names no file"));
    }

    #[test]
    fn sizes_that_no_archive_of_its_size_holds_are_refused() {
        let mut large = manifest(&["a/frame.exr"]);
        large.files[0].bytes = LARGEST_PACK_RATIO * 1000 + LARGEST_PACK_RATIO;
        assert!(parse(&large).unwrap_err().contains("in an archive of 1000"));
        large.files[0].bytes = MOST_TAKEN_BYTES + 1;
        assert!(parse(&large).unwrap_err().contains("allowed: up to"));
    }

    #[test]
    fn another_format_is_refused_before_its_keys_are_read() {
        let refusal = Manifest::parse(br#"{"format": 2, "entries": []}"#, 1000).unwrap_err();
        assert!(refusal.contains("format 2; allowed: 1"), "{refusal}");
    }
}
