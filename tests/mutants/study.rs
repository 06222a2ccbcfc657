//! Data for measuring one filter's mutants.

use std::collections::BTreeMap;

use judge::SceneBounds;
use tracer::SceneId;

use crate::bench::Bench;
use crate::journal::Journal;
use crate::subject::Subject;

/// A filter on the bench.
pub struct Study<'a, 's> {
    pub bench: &'a mut Bench,
    pub subject: &'s Subject,
    pub journal: &'a mut Journal,
    /// Limits for its mutants.
    pub limits: BTreeMap<SceneId, Limits>,
    /// Function that returns whether work may still begin.
    pub due: &'a dyn Fn() -> bool,
}

/// Limits on one scene.
pub struct Limits {
    pub deciding: SceneBounds,
    /// True if they come from bounds.toml.
    pub are_shipped: bool,
    /// Limits on every metric that can have one, which show what would notice a survivor; none until they are calibrated.
    pub widest: Option<SceneBounds>,
}
