//! Scores: numbers with their noise, or reasons why there are none.

use serde::{Deserialize, Serialize};

use crate::Interval;

/// A measured value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The score, in its metric's unit.
    pub value: f64,
    /// Noise floor: the score of the truth's own noise, near which a picture without error scores.
    /// If high values are good, it is the highest value that the truth supports; if a target is
    /// good, it is the distance from the target.
    pub floor: f64,
}

/// A score, or the reason why it would mean nothing here. As JSON: `{"value": .., "floor": ..}` or
/// `{"not_applicable": ".."}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Measured {
    /// A number that means what its metric says.
    Score(Score),
    /// There is no number.
    NotApplicable {
        /// Property of the scene that makes the score meaningless.
        #[serde(rename = "not_applicable")]
        reason: String,
    },
}

/// Ideal value of a score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ideal {
    /// 0 is perfect, lower is better: errors, lengths of bleed.
    Lowest,
    /// The higher the better: PSNR, equivalent sub-frames.
    Highest,
    /// This value is perfect: ratios, signed lengths.
    Target(f64),
}

impl Measured {
    /// Makes a score of a value and its floor, both finite.
    pub fn score(value: f64, floor: f64) -> Self {
        assert!(
            value.is_finite() && floor.is_finite(),
            "a score is finite: pictures are checked before they are measured"
        );
        Self::Score(Score { value, floor })
    }

    /// Makes a score of a value and its floor, if there are both; `reason` says why one may be
    /// missing.
    pub(crate) fn of(value: Option<f64>, floor: Option<f64>, reason: impl Into<String>) -> Self {
        match value.zip(floor) {
            Some((value, floor)) => Self::score(value, floor),
            None => Self::not_applicable(reason),
        }
    }

    /// Makes a score that does not apply, because of `reason`.
    pub fn not_applicable(reason: impl Into<String>) -> Self {
        Self::NotApplicable {
            reason: reason.into(),
        }
    }

    /// Returns the number, if there is one.
    pub fn value(&self) -> Option<f64> {
        match self {
            Self::Score(score) => Some(score.value),
            Self::NotApplicable { .. } => None,
        }
    }
}

impl Ideal {
    /// Converts a value to badness: higher is worse, whatever the metric.
    pub fn badness(self, value: f64) -> f64 {
        match self {
            Ideal::Lowest => value,
            Ideal::Highest => -value,
            Ideal::Target(target) => (value - target).abs(),
        }
    }

    /// Returns the smallest and the largest badness within an interval.
    pub fn badness_within(self, interval: &Interval) -> (f64, f64) {
        let [low, high] = [interval.low, interval.high].map(|end| self.badness(end));
        match self {
            Ideal::Target(target) if interval.holds(target) => (0.0, low.max(high)),
            _ => (low.min(high), low.max(high)),
        }
    }

    /// Converts the value that the truth's noise alone yields to the floor of a score.
    pub(crate) fn floor(self, noise: f64) -> f64 {
        match self {
            Ideal::Lowest | Ideal::Highest => noise,
            Ideal::Target(target) => (noise - target).abs(),
        }
    }
}
