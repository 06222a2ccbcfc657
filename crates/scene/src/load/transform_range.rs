//! Upper limits on how far motions carry and turn objects.

use glam::DVec3;

use crate::Motion;
use crate::limits::{FARTHEST, LARGEST_ANGLE, SMALLEST_SCALE};
use crate::motion::keys::key_times;

/// Range of a motion, or of a chain of motions: it moves a point at distance `d` from its origin to
/// at most `largest_scale * d + offset` from the world's.
#[derive(Clone, Copy)]
pub(super) struct TransformRange {
    largest_scale: f64,
    /// Smallest scale at any key.
    smallest_scale: f64,
    /// Largest translation, in metres.
    offset: f64,
    /// Largest angle that a turn reaches since the key before, in radians.
    angle: f64,
}

impl TransformRange {
    /// Range of an object without motion.
    pub(super) const STILL: Self = Self {
        largest_scale: 1.0,
        smallest_scale: 1.0,
        offset: 0.0,
        angle: 0.0,
    };

    /// Finds the range of a motion over an interval of time, in frames.
    pub(super) fn new(motion: &Motion, [from, to]: [f64; 2]) -> Self {
        let mut range = Self {
            largest_scale: 0.0,
            smallest_scale: f64::INFINITY,
            offset: 0.0,
            angle: 0.0,
        };
        for span in key_times([motion], from, to).windows(2) {
            let segment = motion.segment(0.5 * (span[0] + span[1]));
            let [start, end] = [span[0], span[1]].map(|time| segment.since(time));
            let size = |scale: DVec3| scale.abs().max_element();
            let scale = segment.scale.maxima(start, end, size);
            range.largest_scale = range.largest_scale.max(scale.value);
            let offset = segment.translation.maxima(start, end, DVec3::length);
            range.offset = range.offset.max(offset.value);
            let angles = segment
                .turns()
                .map(|turn| turn.angle.maxima(start, end, f64::abs).value);
            range.angle = range.angle.max(angles.sum());
        }
        for key in &motion.keys {
            range.smallest_scale = range.smallest_scale.min(key.scale.abs().min_element());
        }
        range
    }

    /// Combines the range with a parent's.
    pub(super) fn within(self, parent: Self) -> Self {
        Self {
            largest_scale: parent.largest_scale * self.largest_scale,
            smallest_scale: parent.smallest_scale * self.smallest_scale,
            offset: parent.largest_scale * self.offset + parent.offset,
            angle: parent.angle + self.angle,
        }
    }

    /// Refuses a range that carries a thing of a radius, in metres, too far for 32-bit boxes, turns
    /// it by an angle of too few exact digits, or shrinks it to nothing.
    pub(super) fn check(&self, what: &str, radius: f64) -> Result<(), String> {
        let farthest = self.largest_scale * radius + self.offset;
        if farthest.is_nan() || farthest > FARTHEST {
            return Err(format!(
                "{what} gets as far as {farthest:.1e} m from the origin while it is rendered; allowed: {FARTHEST:e} m; \
                 reduce its translations and scales, and those of its parents"
            ));
        }
        let degrees = self.angle.to_degrees();
        if degrees.is_nan() || degrees > LARGEST_ANGLE {
            return Err(format!(
                "{what} turns by {degrees:.1e} degrees after a key, parents included, while it is rendered; allowed: \
                 {LARGEST_ANGLE:e} degrees; turn it less, or put keys with smaller angles near the instant"
            ));
        }
        if self.smallest_scale < SMALLEST_SCALE {
            return Err(format!(
                "{what} is scaled by {:.1e}, parents included; allowed: {SMALLEST_SCALE:e} or more; give it a larger scale",
                self.smallest_scale
            ));
        }
        Ok(())
    }
}
