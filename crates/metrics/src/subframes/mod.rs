//! Equivalent sub-frames: the number of accumulated sub-frames with the same error.

mod curve;
pub(crate) mod ladder;

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::Measured;

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

/// A count of sub-frames between the ladder's ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subframes {
    /// The count, seldom an integer; the end of the ladder if the error is beyond it.
    pub value: f64,
    /// The highest count that the truth's own noise can resolve.
    pub floor: f64,
    /// Position of the error relative to the ladder.
    #[serde(rename = "reach")]
    pub range: LadderRange,
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
    /// Writes `<1`, `3.7`, `>64`, or `n/a`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Equivalent::Subframes(subframes) => match subframes.range {
                LadderRange::Below => format!("<{}", subframes.value),
                LadderRange::Within => format!("{:.1}", subframes.value),
                LadderRange::Above => format!(">{}", subframes.value),
            },
            Equivalent::NotApplicable { .. } => "n/a".to_owned(),
        };
        f.pad(&text)
    }
}
