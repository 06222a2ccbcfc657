//! Inputs to begin with.

use std::fs;
use std::path::{Path, PathBuf};

use crate::place::Place;
use crate::target::Target;

/// Longest input that gets changed; a longer one is only tried as it is.
const LONGEST: usize = 200_000;

/// An input to begin with.
pub enum Seed {
    /// Bytes that are tried as they are, and changed.
    Bytes(Vec<u8>),
    /// Function that makes the input when needed; tried as it is.
    Made(fn() -> Vec<u8>),
}

/// Returns all inputs that a target begins with, always in the same order: its corpus first.
pub fn read_seeds(target: &Target, place: &Place) -> Vec<Seed> {
    let mut seeds: Vec<Seed> = files(&corpus().join(target.name))
        .map(|path| Seed::Bytes(fs::read(path).unwrap()))
        .collect();
    seeds.extend((target.seeds)(place));
    seeds
}

/// Returns the inputs that may be changed.
pub fn changeable(seeds: &[Seed]) -> Vec<&[u8]> {
    let own = seeds.iter().filter_map(|seed| match seed {
        Seed::Bytes(bytes) if bytes.len() <= LONGEST => Some(bytes.as_slice()),
        _ => None,
    });
    own.collect()
}

/// Returns the path of a file of the repository.
pub fn in_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// Reads as seeds the files below a folder of the repository whose names end this way.
pub fn read_shipped(folder: &str, end: &str) -> Vec<Seed> {
    let folders = files(&in_repository(folder)).flat_map(|path| match path.is_dir() {
        true => files(&path).collect(),
        false => vec![path],
    });
    (folders.filter(|path| path.to_string_lossy().ends_with(end)))
        .map(|path| Seed::Bytes(fs::read(path).unwrap()))
        .collect()
}

fn corpus() -> PathBuf {
    in_repository("tests/fuzz/corpus")
}

/// Lists the files of a folder by name; none if there is no folder.
fn files(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter()
}
