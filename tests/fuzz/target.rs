//! A target of the fuzzer.

use crate::place::Place;
use crate::seeds::Seed;
use crate::targets;

/// One kind of input, and the code that reads it.
pub struct Target {
    /// Name, also of its folder in the corpus, and its word on the command line.
    pub name: &'static str,
    /// Number of its cases among 20,000.
    pub share: u64,
    /// Cases of one worker process: many if a case takes little time.
    pub batch: u64,
    /// Kind of changes to its inputs.
    pub shape: Shape,
    /// Words that are worth trying in an input.
    pub tokens: &'static [&'static str],
    /// Inputs to begin with, beside its corpus.
    pub seeds: fn(&Place) -> Vec<Seed>,
    /// Function that reads an input as the program does. It may refuse the input, and must return.
    pub run: fn(&mut Place, &[u8]),
}

/// Kind of changes to inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Lines of words and numbers.
    Text,
    /// Bytes.
    Bytes,
    /// PNG (chunks), OpenEXR (channels and attributes) or other pictures (bytes). Checksums are made valid again.
    Picture,
    /// SPIR-V (instructions), or bytes.
    Spirv,
    /// A command line, one word per line.
    Words,
}

impl Target {
    /// Returns all targets except those that fail on purpose.
    pub fn all() -> Vec<&'static Target> {
        let all = targets::ALL.iter().copied();
        all.filter(|target| target.share > 0).collect()
    }
}

/// Finds the target of this name.
pub fn find(name: &str) -> Result<&'static Target, String> {
    let found = targets::ALL.iter().find(|target| target.name == name);
    found.copied().ok_or_else(|| {
        let names: Vec<&str> = Target::all().iter().map(|target| target.name).collect();
        format!(
            "no target \"{name}\"; there are {}; an input lies in a folder named after its target, or --targets names it",
            names.join(", ")
        )
    })
}
