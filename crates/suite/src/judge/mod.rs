//! Judgement of a finished run: how each bounded score stands to its limit.

pub mod baseline;
pub mod bounds;
pub mod calibrate;
pub mod check;
mod decoys;
mod evidence;
mod finding;
mod judgement;
mod outcome;
mod worst;

use std::collections::BTreeMap;

use metrics::{Measured, Scores};

use self::bounds::{Bound, Bounds, SceneBounds};
use crate::{Intervals, Run};

pub use decoys::{Decoys, Resemblance};
pub use evidence::add_evidence;
pub use finding::{Finding, MOST_SAMPLES, number};
pub use judgement::{JUDGEMENT_FILE, JUDGEMENT_FORMAT, Judgement};
pub use outcome::{Outcome, outcome};
pub use outcome::{badness_within, limit_as_badness};
pub use worst::Worst;
pub use worst::{BLOCK, CROP, worst_block};

/// The bounds of a run's scenes, by the names that its cases give them.
pub type RunBounds = BTreeMap<String, SceneBounds>;

/// Compares every bounded score of a run with its limit: one finding per filter, scene and bound, in the order of the run's cases.
/// Bars are held to nothing. Pure: reads nothing, writes nothing.
pub fn judge(run: &Run, bounds: &RunBounds) -> Vec<Finding> {
    let filters = run.cases.iter().filter(|case| !case.is_reference);
    filters
        .flat_map(|case| {
            let bounds = (bounds.get(&case.scene))
                .map(|bounds| bounds.of(&case.filter, &case.preset))
                .unwrap_or_default();
            // A run with intervals has some in every case.
            let intervals = (!case.intervals.is_empty()).then_some(&case.intervals);
            judge_scores(&case.scores, intervals, &bounds)
                .into_iter()
                .map(|judged| Finding::new(run, case, judged))
                .collect::<Vec<_>>()
        })
        .collect()
}

/// One bounded score.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Name of the metric.
    pub metric: String,
    /// The bound on it.
    pub bound: Bound,
    /// The score.
    pub measured: Measured,
    /// How the score stands to the bound.
    pub outcome: Outcome,
}

/// Compares every bounded score of one picture with its limit: its interval where `intervals` are given, its value alone
/// otherwise.
pub fn judge_scores(
    scores: &Scores,
    intervals: Option<&Intervals>,
    bounds: &Bounds,
) -> Vec<Judged> {
    let judged = bounds.iter().map(|(name, bound)| {
        let metric = name
            .parse()
            .expect("bounds were checked when they were read");
        let measured = scores.get(metric);
        let interval = intervals.map(|intervals| intervals.get(name));
        Judged {
            metric: name.clone(),
            bound: bound.clone(),
            outcome: outcome(metric, &measured, interval, bound.limit),
            measured,
        }
    });
    judged.collect()
}
