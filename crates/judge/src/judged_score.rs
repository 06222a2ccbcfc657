//! Scores of one picture or one sequence, each compared with its bound.

use measure::{Frames, Intervals, Sequence};
use metrics::{Measured, Metric, Scores};

use crate::bounds::{Bound, Bounds};
use crate::outcome::{Outcome, judge_score};

/// Reason why a sequence has no score.
const NO_SEQUENCE: &str = "a frame of the sequence has no scores";

/// One bounded score and the outcome of its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedScore {
    /// Metric of the score.
    pub metric: Metric,
    /// Bound on the score.
    pub bound: Bound,
    /// Score.
    pub measured: Measured,
    /// Outcome of the bound.
    pub outcome: Outcome,
}

impl JudgedScore {
    /// Compares a score with its limit: by its interval if `intervals` are given, otherwise by its
    /// value.
    fn new(
        metric: Metric,
        bound: &Bound,
        measured: Measured,
        intervals: Option<&Intervals>,
    ) -> Self {
        let interval = intervals.map(|intervals| intervals.get(&metric));
        Self {
            metric,
            bound: bound.clone(),
            outcome: judge_score(metric, &measured, interval, bound.limit),
            measured,
        }
    }
}

/// Compares every bounded score of one picture with its limit: by its interval if `intervals` are
/// given, otherwise by its value. Ignores limits on sequences.
pub fn judge_scores(
    scores: &Scores,
    intervals: Option<&Intervals>,
    bounds: &Bounds,
) -> Vec<JudgedScore> {
    let of_frames = (bounds.iter()).filter(|(metric, _)| !matches!(metric, Metric::Sequence(_)));
    of_frames
        .map(|(metric, bound)| JudgedScore::new(*metric, bound, scores.get(*metric), intervals))
        .collect()
}

/// Compares every bounded score of one sequence with its limit, like [`judge_scores`] for a
/// picture. `frames` are the run's; limits on sequences of another length are not judged.
/// `sequence` is none if a frame failed.
pub(crate) fn judge_sequence(
    sequence: Option<&Sequence>,
    frames: Frames,
    bounds: &Bounds,
) -> Vec<JudgedScore> {
    // A run with intervals has some in every sequence.
    let intervals = sequence.map(|sequence| &sequence.intervals);
    let intervals = intervals.filter(|intervals| !intervals.is_empty());
    let judged = bounds.iter().filter_map(|(metric, bound)| {
        let Metric::Sequence(sequence_metric) = *metric else {
            return None;
        };
        let length = bound.length.expect("a limit on a sequence has a length");
        let judge = |measured| JudgedScore::new(*metric, bound, measured, intervals);
        Some(match sequence {
            _ if !length.holds_for(frames) => JudgedScore {
                outcome: Outcome::NotJudged,
                ..judge(Measured::not_applicable(not_judged(length.text(), frames)))
            },
            Some(sequence) => judge(sequence.scores.get(sequence_metric).clone()),
            None => judge(Measured::not_applicable(NO_SEQUENCE)),
        })
    });
    judged.collect()
}

/// Explains why a limit on a sequence was not judged.
fn not_judged(length: String, frames: Frames) -> String {
    match frames.count {
        1 => format!("its limit holds for {length}, and single frames were measured"),
        count => format!(
            "its limit holds for {length}, and {count} at {} per second were measured",
            frames.per_second
        ),
    }
}
