//! Command line of a filter that is a program.

use std::path::PathBuf;

/// Program that a filter runs, with its arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The program, with a slash in it relative to the filter's folder, else looked up on the PATH;
    /// then its arguments, in which names in braces stand for files and values.
    pub words: Vec<String>,
    /// Absolute folder of filter.toml, in which the program runs.
    pub folder: PathBuf,
    /// Variables of the environment that it gets besides the usual ones.
    pub environment: Vec<String>,
    /// Path of filter.toml, as it was given.
    pub manifest: PathBuf,
    /// Line of the command there, from 1.
    pub line: usize,
}
