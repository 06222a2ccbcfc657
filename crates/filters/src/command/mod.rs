//! Filters that are programs: a frame goes out as a file, and a picture comes back as one.

mod blur;
mod process;
mod words;

use std::path::PathBuf;

pub use blur::CommandBlur;
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
}

impl Command {
    /// Program and arguments as filter.toml has them.
    pub fn words(&self) -> Vec<String> {
        let program = std::iter::once(&self.program);
        program.chain(&self.arguments).cloned().collect()
    }
}
