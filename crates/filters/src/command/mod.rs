//! Filters that are programs: a frame goes out as a file, and a picture comes back as one.

mod blur;
#[cfg(target_os = "linux")]
mod descendants;
mod environment;
mod group;
mod printed;
mod process;
mod words;

use std::path::PathBuf;

pub use blur::{BESIDE_PIXELS, BYTES_PER_PIXEL, CommandBlur};
pub(crate) use words::{PLACEHOLDERS, fill};

/// What a filter runs that is a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The program: with a slash in it relative to the filter's folder, else looked up on the PATH.
    pub program: String,
    /// Its arguments; names in braces stand for files and values.
    pub arguments: Vec<String>,
    /// Absolute folder of filter.toml, in which the program runs.
    pub folder: PathBuf,
    /// Variables of the environment that it gets beside the usual ones.
    pub environment: Vec<String>,
    /// filter.toml, as it was named.
    pub manifest: PathBuf,
    /// Line of the command there, from 1.
    pub line: usize,
}

impl Command {
    /// Program and arguments as filter.toml has them.
    pub fn words(&self) -> Vec<String> {
        let program = std::iter::once(&self.program);
        program.chain(&self.arguments).cloned().collect()
    }
}
