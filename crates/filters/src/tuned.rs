//! Record of how a preset was found.

use serde::{Deserialize, Serialize};

/// What `shuttertruth tune` was asked to do when it found a preset's values: `[preset.tuned]` of filter.toml.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tuned {
    /// Program name and version.
    pub by: String,
    /// The preset that it started from.
    pub from: String,
    /// Of the search's randomness.
    pub seed: u64,
    /// How many candidates there were.
    pub trials: usize,
    /// Pixels per row and rows of the scenes.
    pub size: [u32; 2],
    /// Samples per pixel of the truths.
    pub samples_per_pixel: u32,
    /// The scenes. On these the preset proves nothing.
    pub scenes: Vec<String>,
}
