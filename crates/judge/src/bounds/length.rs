//! Length of the sequence that a limit holds for.

use metrics::Metric;
use suite::{Error, FilterChoice, Frames, MAX_FRAMES};

use crate::bounds::{Bound, SceneBounds};

/// Frames that a limit on a score of a sequence holds for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Number of frames.
    pub frames: u32,
    /// Frames per second; none for a score that does not depend on them.
    pub per_second: Option<f64>,
}

impl Length {
    /// Checks the length that a bound names; none for a metric of single frames. The error says what is allowed.
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

    /// Tells whether a limit of this length holds for the frames of a run.
    pub fn holds_for(self, frames: Frames) -> bool {
        let has_rate = |own| own == frames.per_second;
        self.frames == frames.count && self.per_second.is_none_or(has_rate)
    }

    /// Writes the length: `4 frames at 60 per second`.
    pub fn text(self) -> String {
        match self.per_second {
            None => format!("{} frames", self.frames),
            Some(rate) => format!("{} frames at {rate} per second", self.frames),
        }
    }
}

/// Refuses limits on these filters that hold for another length than that of the sequences that are asked for. Where single frames are
/// asked for, limits on sequences are left alone, and nothing judges them.
pub fn check_lengths<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &[FilterChoice],
    frames: Frames,
) -> Result<(), Error> {
    if frames.is_one() {
        return Ok(());
    }
    for bounds in scenes {
        let bounds =
            (filters.iter()).flat_map(|choice| bounds.of(&choice.filter.name, &choice.preset));
        for (metric, Bound { length, place, .. }) in bounds {
            if let Some(length) = length.filter(|length| !length.holds_for(frames)) {
                let asked = Length {
                    per_second: length.per_second.map(|_| frames.per_second),
                    frames: frames.count,
                };
                return Err(Error::Usage(format!(
                    "{place}: the limit on {metric} holds for sequences of {}, and they are to have {}; measure as many as it \
                     holds for, or measure a limit for the others with `shuttertruth limits calibrate`",
                    length.text(),
                    asked.text()
                )));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn assert_refused(metric: &str, frames: Option<u32>, rate: Option<f64>, part: &str) {
        let refused = Length::check(metric.parse().unwrap(), frames, rate).unwrap_err();
        assert!(refused.contains(part), "{refused}");
    }

    #[test]
    fn a_limit_names_the_frames_that_its_score_depends_on_and_no_others() {
        let found = |metric: &str, frames, rate| {
            let length = Length::check(metric.parse().unwrap(), frames, rate).unwrap();
            length.map(|own| (own.frames, own.per_second))
        };
        assert_eq!(found("flip_moving", None, None), None);
        assert_eq!(found("flicker", Some(4), None), Some((4, None)));
        assert_eq!(found("jod", Some(4), Some(60.0)), Some((4, Some(60.0))));
        assert_refused("flip_moving", Some(4), None, "leave it out");
        assert_refused("flip_moving", None, Some(60.0), "leave it out");
        assert_refused("flicker", None, None, "such as frames = 4");
        assert_refused("flicker", Some(1), None, "allowed: 2 to 1000");
        assert_refused("flicker", Some(4), Some(60.0), "leave fps out");
        assert_refused("jod", Some(4), None, "such as fps = 60");
        assert_refused("jod", Some(4), Some(0.0), "above 0");
    }

    #[test]
    fn a_limit_holds_for_its_own_length_alone() {
        let frames = |count, per_second| Frames { count, per_second };
        let length = |per_second| Length {
            frames: 4,
            per_second,
        };
        assert!(length(None).holds_for(frames(4, 60.0)));
        assert!(length(None).holds_for(frames(4, 24.0)));
        assert!(!length(None).holds_for(frames(3, 60.0)));
        assert!(length(Some(60.0)).holds_for(frames(4, 60.0)));
        assert!(!length(Some(60.0)).holds_for(frames(4, 24.0)));
    }
}
