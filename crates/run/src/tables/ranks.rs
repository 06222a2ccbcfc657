//! Ranks in front of the names of a table's rows.

use judge::{RankedFilter, rank_presets};
use measure::{FilterId, Run};
use scene::FrameRate;

use super::bracket_name;

/// Ranks of all presets of a run, each within its shutter and frame rate.
pub struct Ranks(Vec<RankedFilter>);

impl Ranks {
    /// Ranks the filters of a run by FLIP over its scenes.
    pub fn of(run: &Run) -> Self {
        Self(rank_presets(&run.cases).concat())
    }

    /// Formats a filter after its rank, and a picture without a rank alone.
    pub fn name(&self, filter: &FilterId, rate: Option<FrameRate>) -> String {
        let is_of = |ranked: &&RankedFilter| {
            ranked.name == filter.name
                && ranked.alignment == filter.alignment
                && ranked.rate == rate
        };
        let ranked = self
            .0
            .iter()
            .filter(|ranked| ranked.is_ranked())
            .find(is_of);
        let name = bracket_name(&filter.name, filter.is_reference);
        match ranked {
            Some(ranked) => format!("{} {name}", ranked.rank_text()),
            None => name,
        }
    }
}
