//! Rows of the metrics of sequences.

use serde::{Deserialize, Serialize};

use super::row::{Group, Row, metrics};
use crate::{ErrorMap, Ideal, Measured};

/// Quality of a video without visible difference, in JOD.
pub const PERFECT_JOD: f64 = 10.0;

impl SequenceMetric {
    /// Returns true for a score that depends on the rate at which the frames are shown.
    pub fn depends_on_rate(self) -> bool {
        self == Self::Jod
    }

    /// Converts a score to the number that tables show: thousandths of display white, squared
    /// errors as roots; JOD as it is.
    pub fn shown(self, value: f64) -> f64 {
        match self.row().unit {
            // Only the truth's noise makes it negative.
            "white^2" => 1000.0 * value.max(0.0).sqrt(),
            "JOD" => value,
            _ => 1000.0 * value,
        }
    }

    /// Formats a number that [`shown`](Self::shown) made.
    pub fn shown_text(self, shown: f64) -> String {
        match self {
            Self::Jod => format!("{shown:.2}"),
            _ => format!("{shown:.1}"),
        }
    }

    /// Formats a score as tables show it.
    pub fn text(self, score: &Measured) -> String {
        match score.value() {
            None => "n/a".to_owned(),
            Some(value) => self.shown_text(self.shown(value)),
        }
    }
}

metrics! {
    /// A score of a sequence.
    enum SequenceMetric;
    /// Scores of a sequence of pictures against truths. Squared errors are of display-scaled
    /// radiance, without the bias of the truth's noise, which may make them negative.
    struct SequenceScores of Measured {}

    /// Mean over the frames of the squared error where anything moves.
    Error => error {
        name: "error", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "squared error of single frames where anything moves",
    }

    /// Squared error of the difference between consecutive frames, at fixed places of the screen.
    Flicker => flicker {
        name: "flicker", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "error of the change from frame to frame",
    }

    /// Squared error of that difference along the motion, where both frames show the point.
    FlickerAlong => flicker_along {
        name: "flicker_along", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "error of the change from frame to frame of what the eye follows",
    }

    /// Largest jump between consecutive frames of an object's root mean squared error.
    Popping => popping {
        name: "popping", unit: "white", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "largest jump of an object's error from one frame to the next",
    }

    /// Mean product of the fine errors of different frames at one place of the screen.
    FixedPattern => fixed_pattern {
        name: "fixed_pattern", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "fine error that stays in place on the screen, like dirt on a window",
    }

    /// Quality of the video by ColorVideoVDP, in just-objectionable differences: 10 is no visible
    /// difference.
    Jod => jod {
        name: "jod", unit: "JOD", ideal: Ideal::Highest, group: Group::Time, map: ErrorMap::Flip,
        meaning: "quality of the video that ColorVideoVDP predicts; 10 is no visible difference",
    }

    /// `error` after temporal anti-aliasing of pictures and truths, without the first frame.
    ErrorAfterTaa => error_after_taa {
        name: "error_after_taa", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "squared error that temporal anti-aliasing leaves",
    }

    /// `flicker_along` after temporal anti-aliasing of pictures and truths.
    FlickerAfterTaa => flicker_after_taa {
        name: "flicker_after_taa", unit: "white^2", ideal: Ideal::Lowest, group: Group::Time, map: ErrorMap::SquaredError,
        meaning: "error of the change from frame to frame that temporal anti-aliasing leaves",
    }
}
