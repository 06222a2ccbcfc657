//! Scores of one picture, each compared with its bound.

use metrics::{Measured, Scores};

use super::bounds::{Bound, Bounds};
use super::outcome::{Outcome, judge_score};
use crate::Intervals;

/// One bounded score and the outcome of its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedScore {
    /// Name of the metric.
    pub metric: String,
    /// Bound on the score.
    pub bound: Bound,
    /// Score.
    pub measured: Measured,
    /// Outcome of the bound.
    pub outcome: Outcome,
}

/// Compares every bounded score of one picture with its limit: by its interval if `intervals` are given, by its value alone
/// otherwise.
pub fn judge_scores(
    scores: &Scores,
    intervals: Option<&Intervals>,
    bounds: &Bounds,
) -> Vec<JudgedScore> {
    let judged = bounds.iter().map(|(name, bound)| {
        let metric = name
            .parse()
            .expect("bounds were checked when they were read");
        let measured = scores.get(metric);
        let interval = intervals.map(|intervals| intervals.get(name));
        JudgedScore {
            metric: name.clone(),
            bound: bound.clone(),
            outcome: judge_score(metric, &measured, interval, bound.limit),
            measured,
        }
    });
    judged.collect()
}
