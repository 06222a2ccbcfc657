//! Frame rates, as in names of scenes.

use std::hash::{Hash, Hasher};

use serde::{Deserialize, Serialize};

use crate::limits::{FASTEST_RATE, FASTEST_SHUTTER, SLOWEST_RATE, SLOWEST_SHUTTER};

/// A frame rate, and the rule by which the shutter follows it. In names it is the last word after
/// the scene and its variant: `fan@144fps`, `fan@unlit@24fps_1-48s`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameRate {
    /// Frames per second, from 1 to 1000.
    pub per_second: f64,
    /// Number of exposures that fill a second, 48 for a shutter time of 1/48 s; none for a shutter
    /// that keeps its share of the frame interval.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shutters_per_second: Option<f64>,
}

// No number of a rate is NaN.
impl Eq for FrameRate {}

impl Hash for FrameRate {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.word().hash(state);
    }
}

impl Default for FrameRate {
    fn default() -> Self {
        Self::WRITTEN
    }
}

impl FrameRate {
    /// The rate at which scenes are as their files say: 60 frames per second, and a shutter in
    /// frames.
    pub const WRITTEN: Self = Self {
        per_second: 60.0,
        shutters_per_second: None,
    };

    /// Writes the rate as the word of a name: `144fps`, or `144fps_1-48s` for a shutter in time.
    pub fn word(&self) -> String {
        match self.shutters_per_second {
            None => format!("{}fps", self.per_second),
            Some(count) => format!("{}fps_1-{count}s", self.per_second),
        }
    }

    /// Describes it in words: `144 frames per second, open for 1/48 s`.
    pub fn text(&self) -> String {
        match self.shutters_per_second {
            None => format!("{} frames per second", self.per_second),
            Some(count) => format!(
                "{} frames per second, open for 1/{count} s",
                self.per_second
            ),
        }
    }

    /// Reads the word of a name; none for another word. The numbers may be beyond what
    /// [`FrameRate::check`] allows.
    pub fn in_word(word: &str) -> Option<Self> {
        let (rate, shutter) = match word.split_once("fps")? {
            (rate, "") => (rate, None),
            (rate, rest) => (rate, Some(rest.strip_prefix("_1-")?.strip_suffix('s')?)),
        };
        let rate = Self {
            per_second: rate.parse().ok()?,
            shutters_per_second: shutter.map(str::parse).transpose().ok()?,
        };
        // One rate has one name.
        (rate.per_second.is_finite() && rate.word() == word).then_some(rate)
    }

    /// Refuses numbers beyond the limits; the reason says what is allowed.
    pub fn check(&self) -> Result<(), String> {
        let range = SLOWEST_RATE..=FASTEST_RATE;
        if !range.contains(&self.per_second) {
            return Err(format!(
                "{} frames per second; allowed: {SLOWEST_RATE} to {FASTEST_RATE}",
                self.per_second
            ));
        }
        let range = SLOWEST_SHUTTER..=FASTEST_SHUTTER;
        match self.shutters_per_second {
            Some(count) if !range.contains(&count) => Err(format!(
                "a shutter time of 1/{count} s; allowed: 1/{SLOWEST_SHUTTER} to 1/{FASTEST_SHUTTER}"
            )),
            _ => Ok(()),
        }
    }

    /// Number of frames that pass in the time of one frame of the scene's file.
    pub fn frames_per_written_frame(&self) -> f64 {
        self.per_second / Self::WRITTEN.per_second
    }

    /// Returns the exposure in frames, if the file's is `written`.
    pub fn exposure(&self, written: f64) -> f64 {
        match self.shutters_per_second {
            None => written,
            Some(count) => self.per_second / count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_has_one_word() {
        let rate = |per_second, shutters_per_second| FrameRate {
            per_second,
            shutters_per_second,
        };
        for (word, expected) in [
            ("24fps", Some(rate(24.0, None))),
            ("23.976fps", Some(rate(23.976, None))),
            ("144fps_1-48s", Some(rate(144.0, Some(48.0)))),
            ("0fps", Some(rate(0.0, None))),
            ("-5fps", Some(rate(-5.0, None))),
            ("024fps", None),
            ("24.0fps", None),
            ("fps", None),
            ("24fps_", None),
            ("24fps_48s", None),
            ("24fps_1-48", None),
            ("24fps_1-048s", None),
            ("24", None),
            ("unlit", None),
        ] {
            assert_eq!(FrameRate::in_word(word), expected, "{word}");
            if let Some(rate) = expected {
                assert_eq!(rate.word(), word);
            }
        }
    }
}
