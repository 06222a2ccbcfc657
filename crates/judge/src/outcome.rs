//! Outcome of one bound, and decision of a check.

use metrics::{Ideal, Interval, Measured, Metric};
use serde::{Deserialize, Serialize};

/// Relation of a score to its bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The whole interval of the score is on the right side of the limit, or its value without an
    /// interval.
    Kept,
    /// The whole interval is on the wrong side.
    Broken,
    /// The interval contains the limit, or the truth's parts cannot determine the score.
    Inconclusive,
    /// No interval decides, and the limit is stricter than three floors: noise alone could break
    /// it.
    TooNoisy,
    /// The metric does not apply to this scene.
    NotApplicable,
    /// The limit is on a sequence of another length than the run's.
    NotJudged,
}

impl Outcome {
    /// Returns true for an outcome that people will want explained.
    pub fn is_notable(self) -> bool {
        match self {
            Outcome::Broken | Outcome::Inconclusive | Outcome::TooNoisy => true,
            Outcome::Kept | Outcome::NotApplicable | Outcome::NotJudged => false,
        }
    }
}

/// Result of a check; a later one outweighs an earlier one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// Every required bound is met.
    Pass,
    /// The truth is too noisy to decide some.
    Inconclusive,
    /// A bound is stricter than the truth's noise allows, or no bound applies to a case.
    Misconfigured,
    /// A required bound is broken, or a case failed. The noise of another bound does not change
    /// that.
    Broken,
}

impl Decision {
    /// Returns its word for readers.
    pub fn word(self) -> &'static str {
        match self {
            Decision::Pass => "PASS",
            Decision::Broken => "FAIL",
            Decision::Inconclusive | Decision::Misconfigured => "UNDECIDED",
        }
    }
}

/// Compares a score with a limit: by its interval if `interval` is given, otherwise by its value.
/// `Some(None)` is an interval that the truth cannot determine.
pub fn judge_score(
    metric: Metric,
    measured: &Measured,
    interval: Option<Option<&Interval>>,
    limit: f64,
) -> Outcome {
    let Measured::Score(score) = measured else {
        return Outcome::NotApplicable;
    };
    let ideal = metric.ideal();
    let limit = limit_as_badness(ideal, limit);
    let is_within_noise = limit < limit_as_badness(ideal, metric.strictest_bound(score.floor));
    let (best, worst) = match interval {
        // Noise may have made any part of a value that has no interval.
        None | Some(None) if is_within_noise => return Outcome::TooNoisy,
        None => [ideal.badness(score.value); 2].into(),
        Some(Some(interval)) => ideal.badness_within(interval),
        Some(None) => return Outcome::Inconclusive,
    };
    if worst <= limit {
        Outcome::Kept
    } else if best > limit {
        Outcome::Broken
    } else if is_within_noise {
        Outcome::TooNoisy
    } else {
        Outcome::Inconclusive
    }
}

/// Converts a limit to badness. A limit on the distance from an ideal is badness already.
pub(crate) fn limit_as_badness(ideal: Ideal, limit: f64) -> f64 {
    match ideal {
        Ideal::Highest => -limit,
        Ideal::Lowest | Ideal::Target(_) => limit,
    }
}

#[cfg(test)]
mod tests {
    use metrics::Score;

    use super::*;

    fn interval(low: f64, high: f64) -> Interval {
        Interval {
            low,
            high,
            center: f64::midpoint(low, high),
            standard_error: 0.01,
        }
    }

    #[test]
    fn the_whole_interval_decides_and_the_value_does_not() {
        let measured = Measured::Score(Score {
            value: 0.12,
            floor: 0.01,
        });
        let judge = |low, high| {
            let interval = interval(low, high);
            judge_score(Metric::FLIP, &measured, Some(Some(&interval)), 0.1)
        };
        // The value is above the limit each time: noise raises it.
        assert_eq!(judge(0.08, 0.1), Outcome::Kept);
        assert_eq!(judge(0.09, 0.11), Outcome::Inconclusive);
        assert_eq!(judge(0.11, 0.13), Outcome::Broken);
    }

    #[test]
    fn noise_excuses_only_what_no_interval_decides() {
        // A perfect picture has up to 0.06.
        let measured = Measured::Score(Score {
            value: 0.05,
            floor: 0.02,
        });
        let judge = |interval: Option<Option<&Interval>>, limit| {
            judge_score(Metric::FLIP, &measured, interval, limit)
        };
        for (low, high, expected) in [
            (0.04, 0.05, Outcome::Broken),
            (0.01, 0.03, Outcome::Kept),
            (0.03, 0.04, Outcome::TooNoisy),
        ] {
            assert_eq!(judge(Some(Some(&interval(low, high))), 0.035), expected);
        }
        assert_eq!(judge(Some(None), 0.035), Outcome::TooNoisy);
        assert_eq!(judge(Some(None), 0.065), Outcome::Inconclusive);
        assert_eq!(judge(None, 0.035), Outcome::TooNoisy);
        assert_eq!(judge(None, 0.065), Outcome::Kept);
        let around = interval(0.06, 0.07);
        assert_eq!(judge(Some(Some(&around)), 0.065), Outcome::Inconclusive);
    }

    #[test]
    fn an_interval_is_as_bad_as_its_ends() {
        for (ideal, expected) in [
            (Ideal::Lowest, (0.75, 1.5)),
            (Ideal::Highest, (-1.5, -0.75)),
            (Ideal::Target(1.0), (0.0, 0.5)),
            (Ideal::Target(2.0), (0.5, 1.25)),
            (Ideal::Target(0.5), (0.25, 1.0)),
        ] {
            let badness = ideal.badness_within(&interval(0.75, 1.5));
            assert_eq!(badness, expected, "{ideal:?}");
        }
    }
}
