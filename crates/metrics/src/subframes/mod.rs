//! Equivalent sub-frames: the number of accumulated sub-frames with the same error.

mod count;
mod curve;
pub(crate) mod ladder;

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{Interval, Measured};

pub use count::equivalent;

/// Number of accumulated sub-frames that have the picture's error, or the reason why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Equivalent {
    /// The picture is as good as the mean of this many sub-frames.
    Subframes(Subframes),
    /// There is no count.
    NotApplicable {
        /// Reason.
        #[serde(rename = "not_applicable")]
        reason: String,
    },
}

/// A count of sub-frames, with the 95 % interval that noise leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subframes {
    /// The count, seldom an integer; the end of the ladder if the error is beyond it.
    pub value: f64,
    /// The highest count that the truth's own noise can resolve.
    pub floor: f64,
    /// Lower end of the interval; none if the count may be below the ladder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub low: Option<f64>,
    /// Upper end of the interval; none if the count may be beyond the ladder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub high: Option<f64>,
    /// Position of the error relative to the ladder.
    #[serde(rename = "reach")]
    pub range: LadderRange,
}

impl Subframes {
    /// Makes the count of a rung's own picture, which has no noise.
    pub(crate) fn of_rung(subframes: u32, floor: f64) -> Self {
        let value = f64::from(subframes);
        Self {
            value,
            floor,
            low: Some(value),
            high: Some(value),
            range: LadderRange::Within,
        }
    }

    /// Makes a count whose noise is not known: certain up to the floor.
    fn of_floor(value: f64, floor: f64, range: LadderRange) -> Self {
        let is_open = value > floor || range == LadderRange::Above;
        Self {
            value,
            floor,
            low: (range != LadderRange::Below).then_some(value.min(floor)),
            high: (!is_open).then_some(value),
            range,
        }
    }

    /// Returns the interval, with the ends of the ladder for open ends. `ends` are its first and
    /// last number of sub-frames.
    pub fn interval(&self, ends: [u32; 2]) -> Interval {
        let [first, last] = ends.map(f64::from);
        let (low, high) = (self.low.unwrap_or(first), self.high.unwrap_or(last));
        Interval {
            low,
            high,
            center: self.value,
            // Of a normal distribution.
            standard_error: (high - low) / (2.0 * 1.96),
        }
    }
}

/// Position of an error relative to a ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LadderRange {
    /// Worse than the first rung: `<1`.
    Below,
    /// Between the first rung and the last.
    Within,
    /// No worse than the last: `>64`.
    Above,
}

impl Equivalent {
    /// Makes a score that does not apply, because of `reason`.
    pub(crate) fn not_applicable(reason: &str) -> Self {
        Self::NotApplicable {
            reason: reason.to_owned(),
        }
    }

    /// Converts the count to a score.
    pub fn measured(&self) -> Measured {
        match self {
            Equivalent::Subframes(subframes) => Measured::score(subframes.value, subframes.floor),
            Equivalent::NotApplicable { reason } => Measured::not_applicable(reason),
        }
    }
}

impl fmt::Display for Equivalent {
    /// Writes `3.7`, `>8` if noise does not tell how far above 8, `<1`, or `n/a`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Equivalent::Subframes(subframes) => subframes.to_string(),
            Equivalent::NotApplicable { .. } => "n/a".to_owned(),
        };
        f.pad(&text)
    }
}

impl fmt::Display for Subframes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.range, self.low, self.high) {
            (_, low, None) => write!(f, ">{}", low.unwrap_or(0.0).floor()),
            (LadderRange::Below, None, Some(high)) => write!(f, "<{}", high.ceil()),
            _ => write!(f, "{:.1}", self.value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(value: f64, low: Option<f64>, high: Option<f64>, range: LadderRange) -> Subframes {
        let floor = 64.0;
        Subframes {
            value,
            floor,
            low,
            high,
            range,
        }
    }

    #[test]
    fn a_count_prints_what_is_certain() {
        use LadderRange::{Above, Below, Within};
        for (count, text) in [
            (count(3.7, Some(3.5), Some(3.94), Within), "3.7"),
            (count(20.0, Some(8.9), None, Within), ">8"),
            (count(64.0, Some(64.0), None, Above), ">64"),
            (count(1.0, None, Some(1.0), Below), "<1"),
            (count(1.0, None, Some(1.2), Below), "<2"),
            (count(1.5, None, None, Within), ">0"),
            (Subframes::of_rung(64, 8.0), "64.0"),
            (Subframes::of_floor(3.0, 12.5, Within), "3.0"),
            (Subframes::of_floor(30.0, 12.5, Within), ">12"),
            (Subframes::of_floor(64.0, 64.0, Above), ">64"),
            (Subframes::of_floor(1.0, 12.5, Below), "<1"),
        ] {
            assert_eq!(count.to_string(), text, "{count:?}");
        }
    }

    #[test]
    fn open_ends_of_an_interval_are_the_ladders() {
        let interval = |low, high| {
            let ends = count(8.0, low, high, LadderRange::Within).interval([1, 64]);
            [ends.low, ends.high]
        };
        assert_eq!(interval(Some(6.0), Some(9.0)), [6.0, 9.0]);
        assert_eq!(interval(None, None), [1.0, 64.0]);
    }
}
