//! Presets: named values for a filter's parameters, and where they come from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::parameter::Value;

/// Named values for a filter's parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Preset {
    /// Name on the command line.
    pub name: String,
    /// Explanation in one line.
    pub doc: String,
    /// The work that it follows, if any.
    pub source: Option<Source>,
    /// Width in pixels of the pictures that its author made it for; `None` if no parameter
    /// depends on it, or it is unknown.
    pub reference_width: Option<u32>,
    /// The values that differ from the parameters' defaults.
    pub values: BTreeMap<String, Value>,
    /// Record of the tuning that found the values, if any.
    pub tuned: Option<TuningRecord>,
}

/// Work that a preset follows, and where the preset departs from it: `[preset.source]` of
/// filter.toml.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Source {
    /// The source code; `None` if only a publication was followed.
    #[serde(flatten)]
    pub code: Option<Code>,
    /// The paper, article or slides.
    pub publication: Option<String>,
    /// Deliberate differences, a sentence each.
    pub differs: Vec<String>,
}

/// Files of a repository, as of one commit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Code {
    /// Its address, `https://...`.
    pub repository: String,
    /// 40 hexadecimal digits.
    pub commit: String,
    /// The files that were followed, from the top of the repository.
    pub paths: Vec<String>,
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            repository,
            commit,
            paths,
        } = self;
        write!(f, "{repository} at {commit}: {}", paths.join(", "))
    }
}

/// Record of the tuning that found a preset's values: `[preset.tuned]` of filter.toml.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TuningRecord {
    /// Program name and version.
    pub by: String,
    /// The preset that it started from.
    pub from: String,
    /// Seed of the search's random numbers.
    pub seed: u64,
    /// Number of candidates.
    pub trials: usize,
    /// Pixels per row and rows of the scenes.
    pub size: [u32; 2],
    /// Samples per pixel of the truths.
    pub samples_per_pixel: u32,
    /// The scenes. The preset's scores on these prove nothing.
    pub scenes: Vec<String>,
}
