//! Command line of a filter that is a program.

use std::path::PathBuf;

/// Program that a filter runs, with its arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The program: with a slash in it relative to the filter's folder, else looked up on the PATH.
    pub program: String,
    /// Its arguments; names in braces stand for files and values.
    pub arguments: Vec<String>,
    /// Absolute folder of filter.toml, in which the program runs.
    pub folder: PathBuf,
    /// Variables of the environment that it gets besides the usual ones.
    pub environment: Vec<String>,
    /// Path of filter.toml, as it was given.
    pub manifest: PathBuf,
    /// Line of the command there, from 1.
    pub line: usize,
}

impl Command {
    /// Lists program and arguments as filter.toml has them.
    pub fn words(&self) -> Vec<String> {
        let program = std::iter::once(&self.program);
        program.chain(&self.arguments).cloned().collect()
    }
}
