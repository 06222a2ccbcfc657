//! Result of measuring one picture.

use frame::Plane;

use crate::{ErrorMap, Maps, ProbeMaps, Scores};

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

impl Measurement {
    /// Returns a map; `None` for one of probes if none were run.
    pub fn map(&self, map: ErrorMap) -> Option<&Plane> {
        map.find(&self.maps, self.probes.as_ref())
    }
}
