//! First line of a tuning's journal.

use std::collections::BTreeMap;

use filters::Value;
use serde::{Deserialize, Serialize};

use crate::objective::Objective;

/// Version of the layout of a journal.
pub const JOURNAL_FORMAT: u32 = 1;

/// Everything that trials depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalHeader {
    /// [`JOURNAL_FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Filter name.
    pub filter: String,
    /// Preset that tuning started from.
    pub start: String,
    /// The preset's value of every parameter.
    pub values: BTreeMap<String, Value>,
    /// Parameters that may change, each with its range in words.
    pub vary: BTreeMap<String, String>,
    /// Points that the search begins with, one coordinate per line of `vary` in the order of the filter's parameters.
    pub design: Vec<Vec<f64>>,
    /// Scene names in the order in which candidates meet them, each with the content hash of its truth.
    pub scenes: Vec<(String, String)>,
    /// Scores that are measured.
    pub objectives: Vec<Objective>,
    /// Upper limit on the cost, as a ratio to the start's.
    pub cost_at_most: Option<f64>,
    /// Upper limit on the lateral bleed of the worst scene, as a ratio to the start's.
    pub bleed_at_most: Option<f64>,
    /// True if candidates that are clearly worse are dropped.
    pub race: bool,
    /// Seed of the search.
    pub seed: u64,
}
