//! Sequence length of a limit.

use measure::{Frames, MAX_FRAMES};
use metrics::Metric;

/// Frames that a limit on a score of a sequence is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Number of frames.
    pub frames: u32,
    /// Frames per second; none for a score that does not depend on them.
    pub per_second: Option<f64>,
}

impl Length {
    /// Checks the length that a bound names; none for a metric of single frames. The error says
    /// what is allowed.
    pub(super) fn check(
        metric: Metric,
        frames: Option<u32>,
        per_second: Option<f64>,
    ) -> Result<Option<Self>, String> {
        let Metric::Sequence(of_sequence) = metric else {
            let given = (frames.map(|_| "frames")).or(per_second.map(|_| "fps"));
            return match given {
                None => Ok(None),
                Some(given) => Err(format!(
                    "{metric}: is a score of a single frame, and {given} is for scores of sequences; leave it out"
                )),
            };
        };
        let Some(frames) = frames else {
            return Err(format!(
                "{metric}: is a score of a sequence, and its limit names no number of frames; needed: the number that it was \
                 measured with, such as frames = 4"
            ));
        };
        if !(2..=MAX_FRAMES).contains(&frames) {
            return Err(format!(
                "{metric}: frames = {frames}; allowed: 2 to {MAX_FRAMES}"
            ));
        }
        match per_second {
            None if of_sequence.depends_on_rate() => Err(format!(
                "{metric}: depends on the rate at which frames are shown, and its limit names none; needed: frames per second, \
                 such as fps = 60"
            )),
            Some(_) if !of_sequence.depends_on_rate() => Err(format!(
                "{metric}: does not depend on the rate at which frames are shown; leave fps out"
            )),
            Some(rate) if !(rate.is_finite() && rate > 0.0) => Err(format!(
                "{metric}: fps = {rate}; allowed: a number above 0, such as 60"
            )),
            _ => Ok(Some(Self { frames, per_second })),
        }
    }

    /// Returns whether a limit of this length is for the frames of a run.
    pub fn holds_for(self, frames: Frames) -> bool {
        let has_rate = |rate| rate == frames.per_second;
        self.frames == frames.count && self.per_second.is_none_or(has_rate)
    }

    /// Formats the length: `4 frames at 60 per second`.
    pub fn text(self) -> String {
        match self.per_second {
            None => format!("{} frames", self.frames),
            Some(rate) => format!("{} frames at {rate} per second", self.frames),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_names_the_frames_that_its_score_depends_on_and_no_others() {
        for (metric, frames, rate, part) in [
            ("flip_moving", None, Some(60.0), "leave it out"),
            ("flicker", Some(1), None, "allowed: 2 to 1000"),
            ("flicker", Some(4), Some(60.0), "leave fps out"),
            ("jod", Some(4), Some(0.0), "above 0"),
        ] {
            let refused = Length::check(metric.parse().unwrap(), frames, rate).unwrap_err();
            assert!(refused.contains(part), "{refused}");
        }
    }
}
