//! A target of the fuzzer.

use crate::place::Place;
use crate::targets::ALL;

/// Approximate sum of the targets' shares.
pub const SHARES: u64 = 20_000;

/// One kind of input, and the code that reads it.
pub struct Target {
    /// Name, also of its folder in the corpus.
    pub name: &'static str,
    /// Number of its cases among [`SHARES`]; 0 if it is left out.
    pub share: u64,
    /// Kind of changes to its inputs.
    pub shape: Shape,
    /// Initial inputs in addition to its corpus.
    pub seeds: fn(&Place) -> Vec<Vec<u8>>,
    /// Function that reads an input like the program. It may refuse the input, and must return.
    pub run: Run,
}

/// Reads an input; none if it was refused. A seed must not be refused if its name begins with `valid`.
pub type Run = fn(&mut Place, &[u8]) -> Option<()>;

/// Kind of changes to inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Lines of words and numbers, with the dictionary of this name.
    Text(&'static str),
    /// Bytes.
    Bytes,
    /// PNG (chunks), OpenEXR (channels and attributes) or other pictures (bytes). Checksums are made valid again.
    Picture,
    /// SPIR-V (instructions), or bytes.
    Spirv,
    /// A command line, one word per line.
    CommandLine,
}

impl Target {
    /// Makes a target whose only seeds are its corpus.
    pub const fn new(name: &'static str, share: u64, shape: Shape, run: Run) -> Self {
        Self {
            name,
            share,
            shape,
            seeds: |_| Vec::new(),
            run,
        }
    }

    /// Adds seeds.
    pub const fn seeds(mut self, seeds: fn(&Place) -> Vec<Vec<u8>>) -> Self {
        self.seeds = seeds;
        self
    }

    /// Returns the number of cases that one process tries: targets with few cases are slow.
    pub fn batch(&self) -> u64 {
        (self.share / 6).max(25)
    }
}

/// Finds the target of this name.
pub fn find(name: &str) -> Result<&'static Target, String> {
    let found = ALL.iter().find(|target| target.name == name);
    let names = || ALL.each_ref().map(|target| target.name).join(", ");
    found.ok_or_else(|| format!("no target \"{name}\"; allowed: {}", names()))
}
