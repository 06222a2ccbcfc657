//! How far motions carry what they move, as upper bounds: positions must stay within what 32-bit boxes can hold the area of.

use glam::DVec3;

use crate::Motion;
use crate::limits::{FARTHEST, SMALLEST_SCALE};
use crate::motion::keys::key_times;

/// What a motion, or a chain of them, does to a point at the distance `d` from the origin: it ends up at most
/// `scale * d + offset` from the world's.
#[derive(Clone, Copy)]
pub(super) struct Reach {
    /// Greatest factor.
    scale: f64,
    /// Smallest factor, at the keys.
    smallest: f64,
    /// Metres.
    offset: f64,
}

impl Reach {
    /// Of what stands in the world.
    pub(super) const WORLD: Self = Self {
        scale: 1.0,
        smallest: 1.0,
        offset: 0.0,
    };

    /// Of a motion during an interval of time, in frames.
    pub(super) fn of(motion: &Motion, [from, to]: [f64; 2]) -> Self {
        let mut reach = Self {
            scale: 0.0,
            smallest: f64::INFINITY,
            offset: 0.0,
        };
        for span in key_times([motion], from, to).windows(2) {
            let segment = motion.segment(0.5 * (span[0] + span[1]));
            let [start, end] = [span[0], span[1]].map(|time| segment.since(time));
            let size = |scale: DVec3| scale.abs().max_element();
            reach.scale = reach
                .scale
                .max(segment.scale.maxima(start, end, size).value);
            let offset = segment.translation.maxima(start, end, DVec3::length);
            reach.offset = reach.offset.max(offset.value);
        }
        for key in &motion.keys {
            reach.smallest = reach.smallest.min(key.scale.abs().min_element());
        }
        reach
    }

    /// The same in a space that is itself carried.
    pub(super) fn within(self, outer: Self) -> Self {
        Self {
            scale: outer.scale * self.scale,
            smallest: outer.smallest * self.smallest,
            offset: outer.scale * self.offset + outer.offset,
        }
    }

    /// Says what is wrong where something of so many metres around its origin is carried so, if anything.
    pub(super) fn amiss(&self, what: &str, radius: f64) -> Option<String> {
        let farthest = self.scale * radius + self.offset;
        if farthest.is_nan() || farthest > FARTHEST {
            return Some(format!(
                "{what} reaches up to {farthest:.1e} m from the origin while it is rendered; allowed: {FARTHEST:e} m; \
                 bring its translations, scales and keys nearer, and those of its parents"
            ));
        }
        (self.smallest < SMALLEST_SCALE).then(|| {
            format!(
                "{what} is scaled by {:.1e}, its parents included; allowed: {SMALLEST_SCALE:e} and above; scale it less",
                self.smallest
            )
        })
    }
}
