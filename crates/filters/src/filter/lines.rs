//! Lines of `filter.toml` that declare the parts of a filter.

use std::path::PathBuf;

/// Lines of declarations in `filter.toml`, from 1, for messages.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    pub path: PathBuf,
    pub parameters: Vec<usize>,
    pub presets: Vec<usize>,
    pub textures: Vec<usize>,
    pub passes: Vec<usize>,
}
