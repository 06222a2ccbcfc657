//! What a score is worth against its limit.

use std::str::FromStr;

use metrics::{Ideal, Interval, Measured, Metric, Scores};
use serde::{Deserialize, Serialize};

use crate::Intervals;
use crate::bounds::{Bound, Bounds, Level};
use crate::worst::Worst;

/// How one score stands to its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the metric.
    pub metric: String,
    /// What is allowed.
    pub limit: f64,
    /// Why that much.
    pub why: String,
    /// What it means to break it.
    pub level: Level,
    /// File and line of the bound.
    pub place: String,
    /// How it turned out.
    pub outcome: Outcome,
    /// Where the error is largest; none for a bound that is kept, or where it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<Worst>,
}

/// Whether a score keeps its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Outcome {
    /// On the right side of the limit: all of its interval, where it has one.
    Kept {
        /// The score.
        value: f64,
    },
    /// On the wrong side.
    Broken {
        /// The score.
        value: f64,
    },
    /// The score's interval lies on both sides of the limit, or parts of the truth cannot tell the score.
    Inconclusive {
        /// The score.
        value: f64,
    },
    /// The limit is stricter than the truth's noise can carry, three floors: neither kept nor broken.
    TooNoisy {
        /// The score's noise floor.
        floor: f64,
        /// The strictest limit that this floor can carry.
        strictest: f64,
    },
    /// The metric does not apply to this scene.
    NotApplicable {
        /// Why not.
        reason: String,
    },
}

impl Verdict {
    /// Whether a person will want to see why.
    pub(crate) fn is_notable(&self) -> bool {
        matches!(
            self.outcome,
            Outcome::Broken { .. } | Outcome::Inconclusive { .. } | Outcome::TooNoisy { .. }
        )
    }
}

/// Compares every bounded score with its limit: its interval where `intervals` are given, its value alone otherwise. Pure:
/// reads nothing, prints nothing.
pub fn judge(scores: &Scores, intervals: Option<&Intervals>, bounds: &Bounds) -> Vec<Verdict> {
    bounds
        .iter()
        .map(|(name, bound)| {
            let metric = Metric::from_str(name).expect("bounds were checked when they were read");
            let interval = intervals.map(|intervals| intervals.get(name));
            Verdict {
                metric: name.clone(),
                limit: bound.limit,
                why: bound.why.clone(),
                level: bound.level,
                place: bound.place.clone(),
                outcome: outcome(metric, &scores.get(metric), interval, bound),
                worst: None,
            }
        })
        .collect()
}

fn outcome(
    metric: Metric,
    measured: &Measured,
    interval: Option<Option<&Interval>>,
    bound: &Bound,
) -> Outcome {
    let score = match measured {
        Measured::Score(score) => score,
        Measured::NotApplicable { reason } => {
            return Outcome::NotApplicable {
                reason: reason.clone(),
            };
        }
    };
    let (value, floor) = (score.value, score.floor);
    let ideal = metric.ideal();
    let strictest = metric.strictest_bound(floor);
    let limit = limit_as_badness(ideal, bound.limit);
    if limit < limit_as_badness(ideal, strictest) {
        return Outcome::TooNoisy { floor, strictest };
    }
    let (best, worst) = match interval {
        None => (ideal.badness(value), ideal.badness(value)),
        Some(Some(interval)) => badness_within(ideal, interval),
        Some(None) => return Outcome::Inconclusive { value },
    };
    if worst <= limit {
        Outcome::Kept { value }
    } else if best > limit {
        Outcome::Broken { value }
    } else {
        Outcome::Inconclusive { value }
    }
}

/// A limit as how bad a score may be. A limit on a distance from an ideal is one already.
pub(crate) fn limit_as_badness(ideal: Ideal, limit: f64) -> f64 {
    match ideal {
        Ideal::Highest => -limit,
        Ideal::Lowest | Ideal::Target(_) => limit,
    }
}

/// How bad the score is at best and at worst within its interval.
pub(crate) fn badness_within(ideal: Ideal, interval: &Interval) -> (f64, f64) {
    let [low, high] = [interval.low, interval.high].map(|end| ideal.badness(end));
    match ideal {
        Ideal::Target(target) if (interval.low..=interval.high).contains(&target) => {
            (0.0, low.max(high))
        }
        _ => (low.min(high), low.max(high)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_as_bad_as_its_ends() {
        let interval = Interval {
            low: 0.75,
            high: 1.5,
            standard_error: 0.1,
        };
        for (ideal, expected) in [
            (Ideal::Lowest, (0.75, 1.5)),
            (Ideal::Highest, (-1.5, -0.75)),
            (Ideal::Target(1.0), (0.0, 0.5)),
            (Ideal::Target(2.0), (0.5, 1.25)),
            (Ideal::Target(0.5), (0.25, 1.0)),
        ] {
            assert_eq!(badness_within(ideal, &interval), expected, "{ideal:?}");
        }
    }
}
