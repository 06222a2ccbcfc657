//! A motion within an interval, with its segments worked out in advance.

use glam::DAffine3;

use crate::motion::{Motion, Segment};
use crate::swept::key_times;

/// Segments in order of time; at least one.
pub(crate) struct Track {
    /// Each with the time at which the next one begins, in frames.
    segments: Vec<(f64, Segment)>,
}

impl Track {
    /// Of a motion between two times.
    pub fn of(motion: &Motion, from: f64, to: f64) -> Self {
        let times = key_times([motion], from, to);
        let ends = if times.len() > 1 { &times[1..] } else { &times };
        let starts = times.iter();
        Self {
            segments: starts
                .zip(ends)
                .map(|(&start, &end)| (end, motion.segment(0.5 * (start + end))))
                .collect(),
        }
    }

    /// What [`Motion::at`] gives, for a time in the interval.
    pub fn at(&self, time: f64) -> DAffine3 {
        let last = self.segments.len() - 1;
        let segment = self.segments[..last]
            .iter()
            .position(|(end, _)| time < *end);
        self.segments[segment.unwrap_or(last)].1.at(time)
    }

    /// Whether nothing changes.
    pub fn stands_still(&self) -> bool {
        self.segments
            .iter()
            .all(|(_, segment)| segment.stands_still())
    }
}
