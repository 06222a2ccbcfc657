//! Motion through keys: position, orientation and scale.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::model::{Interpolation, Key, Motion, Turn};
use crate::motion::curve::{Cubic, Keyed};

/// A part of a motion without keys inside, as polynomials in time.
pub struct Segment {
    /// Time that the curves count from, in frames.
    pub start: f64,
    /// Metres.
    pub translation: Cubic<DVec3>,
    /// Factors along the axes.
    pub scale: Cubic<DVec3>,
    /// Orientation at the start.
    pub orientation: DQuat,
    /// Turn since the start.
    pub turn: Rotation,
    /// Rotations before and after the turn.
    pub swings: Option<[Rotation; 2]>,
}

/// A rotation about a fixed axis by an angle that changes.
pub struct Rotation {
    /// Unit vector.
    pub axis: DVec3,
    /// Radians.
    pub angle: Cubic<f64>,
}

impl Motion {
    /// Transform from the object's space to its parent's at `time` (frames).
    pub fn at(&self, time: f64) -> DAffine3 {
        self.segment(time).at(time)
    }

    /// The derivative of [`Motion::at`] just before `time` (frames), per frame.
    pub fn rate_before(&self, time: f64) -> DAffine3 {
        self.segment_at(self.keyed().segment_before(time))
            .rate(time)
    }

    /// An upper limit on the angular velocity within `[from, to]`, an interval without keys inside,
    /// in radians per frame; exact if the motion is linear.
    pub fn fastest_turn(&self, from: f64, to: f64) -> f64 {
        let segment = self.segment(0.5 * (from + to));
        let [from, to] = [from, to].map(|time| segment.since(time));
        let speeds = segment
            .turns()
            .map(|turn| turn.angle.maxima(from, to, f64::abs).slope);
        speeds.sum()
    }

    /// The segment that contains `time`; at a key, the one that begins there.
    pub fn segment(&self, time: f64) -> Segment {
        self.segment_at(self.keyed().segment(time))
    }

    /// All segments: before the first key, and from each key on.
    pub fn segments(&self) -> impl Iterator<Item = Segment> {
        (0..=self.keys.len()).map(|index| self.segment_at(index))
    }

    fn keyed(&self) -> Keyed<'_, Key> {
        Keyed {
            keys: &self.keys,
            time: |key: &Key| key.time,
            interpolation: self.interpolation,
        }
    }

    fn segment_at(&self, index: usize) -> Segment {
        let keyed = self.keyed();
        let key = |index: usize| &self.keys[index];
        let chord = |part: fn(&Key) -> DVec3| {
            move |from: usize| {
                let [from, to] = [key(from), key(from + 1)];
                (part(to) - part(from)) / (to.time - from.time)
            }
        };
        let curve = |part: fn(&Key) -> DVec3| {
            keyed.curve(index, |key_index| part(key(key_index)), chord(part))
        };
        let anchor = key(keyed.anchor(index));
        let (turn, swings) = rotations(&keyed, index);
        Segment {
            start: anchor.time,
            translation: curve(|key| key.translation),
            scale: curve(|key| key.scale),
            orientation: anchor.orientation,
            turn,
            swings,
        }
    }
}

/// The turn over a segment, and the swings before and after it.
fn rotations(keyed: &Keyed<Key>, segment: usize) -> (Rotation, Option<[Rotation; 2]>) {
    let turn = |from: usize| keyed.keys[from].turn;
    let chord = |from: usize| turn(from).angle / keyed.duration(from) * turn(from).axis;
    let from = keyed.anchor(segment);
    if !keyed.is_between(segment) || keyed.interpolation == Interpolation::Linear {
        let spin = keyed.slope(from, &chord);
        let angle = Cubic::line(0.0, spin.length());
        return (Rotation::about(spin, angle), None);
    }
    let Turn { axis, angle } = turn(from);
    let spins = [from, segment].map(|key| keyed.slope(key, &chord));
    let along = spins.map(|spin| spin.dot(axis));
    let across = [0, 1].map(|end| spins[end] - along[end] * axis);
    let duration = keyed.duration(from);
    let swing =
        |across: DVec3, slopes| Rotation::about(across, Cubic::between([0.0; 2], slopes, duration));
    let swings = [
        swing(across[0], [across[0].length(), 0.0]),
        swing(across[1], [0.0, across[1].length()]),
    ];
    let angle = Cubic::between([0.0, angle], along, duration);
    (Rotation { axis, angle }, Some(swings))
}

impl Rotation {
    /// A rotation about the direction of a vector. If the vector is zero, so must the angle be.
    fn about(direction: DVec3, angle: Cubic<f64>) -> Self {
        let axis = direction.try_normalize().unwrap_or(Turn::NONE.axis);
        Self { axis, angle }
    }

    #[inline]
    fn at(&self, since: f64) -> DQuat {
        DQuat::from_axis_angle(self.axis, self.angle.at(since))
    }
}

impl Segment {
    /// The pose at `time` (frames) within the segment.
    #[inline]
    pub fn at(&self, time: f64) -> DAffine3 {
        let since = self.since(time);
        let mut turn = self.turn.at(since);
        if let Some([before, after]) = &self.swings {
            turn = after.at(since) * turn * before.at(since);
        }
        DAffine3::from_scale_rotation_translation(
            self.scale.at(since),
            turn * self.orientation,
            self.translation.at(since),
        )
    }

    /// The derivative of the pose at `time` (frames), per frame. Its last row is zero.
    fn rate(&self, time: f64) -> DAffine3 {
        let since = self.since(time);
        let mut orientation = self.orientation;
        // Angular velocity in the parent's axes, radians per frame.
        let mut spin = DVec3::ZERO;
        for turn in self.turns() {
            let rotation = turn.at(since);
            spin = rotation * spin + turn.angle.slope(since) * turn.axis;
            orientation = rotation * orientation;
        }
        let axes = DMat3::from_quat(orientation);
        let [scale, growth] = [self.scale.at(since), self.scale.slope(since)];
        let columns = [0, 1, 2].map(|index| {
            let axis = axes.col(index);
            scale[index] * spin.cross(axis) + growth[index] * axis
        });
        DAffine3 {
            matrix3: DMat3::from_cols(columns[0], columns[1], columns[2]),
            translation: self.translation.slope(since),
        }
    }

    /// Frames since the start, as the curves count them.
    #[inline]
    pub fn since(&self, time: f64) -> f64 {
        time - self.start
    }

    /// All rotations in the order in which they are applied.
    pub fn turns(&self) -> impl Iterator<Item = &Rotation> {
        let [before, after] = self
            .swings
            .as_ref()
            .map_or([None; 2], |[before, after]| [Some(before), Some(after)]);
        before.into_iter().chain([&self.turn]).chain(after)
    }

    /// Returns true if nothing changes within the segment.
    pub fn stands_still(&self) -> bool {
        self.translation.is_constant()
            && self.scale.is_constant()
            && self.turns().all(|turn| turn.angle.is_constant())
    }
}

/// Times of `motions`' keys strictly between `from` and `to`, with both ends, rising.
pub fn key_times<'a>(
    motions: impl IntoIterator<Item = &'a Motion>,
    from: f64,
    to: f64,
) -> Vec<f64> {
    let keys = motions.into_iter().flat_map(|motion| &motion.keys);
    times_within(keys.map(|key| key.time), from, to)
}

/// The times strictly between `from` and `to`, with both ends, rising and each once.
pub fn times_within(times: impl IntoIterator<Item = f64>, from: f64, to: f64) -> Vec<f64> {
    let inside = (times.into_iter()).filter(|time| from < *time && *time < to);
    let mut times: Vec<f64> = inside.chain([from, to]).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}
