//! Result of measuring one picture.

use crate::{Maps, ProbeMaps, Scores};

/// Scores, and the maps that they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// The numbers.
    pub scores: Scores,
    /// The pictures.
    pub maps: Maps,
    /// Maps of probes, if any were run.
    pub probes: Option<ProbeMaps>,
}
