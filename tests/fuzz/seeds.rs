//! Initial inputs.

use std::fs;
use std::path::PathBuf;

use fastrand::Rng;

use crate::fixture::files;
use crate::mutation::mutate;
use crate::options::Options;
use crate::place::Place;
use crate::target::Target;

/// Longest input that is changed; a longer one is only tried unchanged.
const MAX_LENGTH: usize = 200_000;

/// Initial inputs of a target, always in the same order.
pub struct Seeds {
    target: &'static Target,
    seed: u64,
    inputs: Vec<Vec<u8>>,
    /// Files of the first inputs.
    paths: Vec<PathBuf>,
    /// Compressed inputs, which are large and only tried unchanged.
    packed: Vec<PathBuf>,
}

impl Seeds {
    /// Reads the corpus of a target and makes its other seeds, or uses the one requested input.
    pub fn read(target: &'static Target, options: &Options, place: &Place) -> Self {
        let corpus = in_repository("tests/fuzz/corpus").join(target.name);
        let paths = match &options.input {
            Some(path) => vec![path.clone()],
            None => files(&corpus, ""),
        };
        let (packed, paths): (Vec<_>, Vec<_>) = paths
            .into_iter()
            .partition(|path| path.extension().is_some_and(|end| end == "zst"));
        let mut inputs = read_all(&paths);
        if options.input.is_none() {
            inputs.extend((target.seeds)(place));
        }
        Self {
            target,
            seed: options.seed,
            inputs,
            paths,
            packed,
        }
    }

    /// Returns the number of cases that are tried unchanged.
    pub fn count(&self) -> u64 {
        (self.inputs.len() + self.packed.len()) as u64
    }

    /// Returns whether a case is a seed that must not be refused: otherwise an outdated layout would go unnoticed.
    pub fn is_valid(&self, case: u64) -> bool {
        let name = self.paths.get(case as usize).and_then(|it| it.file_name());
        name.is_some_and(|name| name.to_string_lossy().starts_with("valid"))
    }

    /// Makes the input of a case: first the unchanged seeds, then changed ones.
    pub fn make(&self, place: &Place, case: u64) -> Vec<u8> {
        let index = case as usize;
        if let Some(input) = self.inputs.get(index) {
            return input.clone();
        }
        if let Some(path) = self.packed.get(index - self.inputs.len()) {
            let packed = fs::File::open(path).expect("the corpus can be read");
            return zstd::decode_all(packed).expect("the corpus can be unpacked");
        }
        let short = self.inputs.iter().filter(|it| it.len() <= MAX_LENGTH);
        let short: Vec<&[u8]> = short.map(Vec::as_slice).collect();
        let key = format!("{} {} {case}", self.seed, self.target.name);
        let hash = blake3::hash(key.as_bytes());
        let key = hash.as_bytes().first_chunk().expect("a hash has 32 bytes");
        let mut random = Rng::with_seed(u64::from_le_bytes(*key));
        mutate(self.target, place, &short, &mut random)
    }
}

/// Returns the path of a file of the repository.
pub fn in_repository(path: &str) -> PathBuf {
    tests::root().join(path)
}

/// Reads the files below a folder of the repository with this ending.
pub fn shipped(folder: &str, end: &str) -> Vec<Vec<u8>> {
    read_all(&files(&in_repository(folder), end))
}

/// Reads the files below a folder of the fixture with one of these endings.
pub fn made(place: &Place, folder: &str, ends: &[&str]) -> Vec<Vec<u8>> {
    let find = |end| {
        let found = files(&place.fixture.join(folder), end);
        assert!(!found.is_empty(), "the fixture has no {folder}/*{end}");
        read_all(&found)
    };
    ends.iter().flat_map(|end| find(end)).collect()
}

fn read_all(paths: &[PathBuf]) -> Vec<Vec<u8>> {
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}
