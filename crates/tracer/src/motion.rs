//! Rigid motion between keys: position linear, orientation at constant angular velocity, scale linear.

use glam::{DAffine3, DQuat, DVec3};

/// A rotation about a fixed axis; more than one turn is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Unit vector.
    pub axis: DVec3,
    /// Radians, right-handed about `axis`.
    pub angle: f64,
}

/// A pose at one time, and the way to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Frames relative to the instant.
    pub time: f64,
    /// Metres.
    pub translation: DVec3,
    /// Unit quaternion.
    pub orientation: DQuat,
    /// Factor per axis, applied before the rotation; never 0.
    pub scale: DVec3,
    /// Rotation from this key to the next, in the parent's axes; none at the last key.
    pub turn: Turn,
}

/// Keys in rising order of time; at least one. Before the first and after the last key the motion goes on at the
/// velocity of the nearest segment: a motion does not stop because its keys end. A single key stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// The poses, times strictly rising.
    pub keys: Vec<Key>,
}

impl Turn {
    /// No rotation.
    pub const NONE: Turn = Turn {
        axis: DVec3::Y,
        angle: 0.0,
    };
}

impl Key {
    /// The identity pose at time 0.
    pub const REST: Key = Key {
        time: 0.0,
        translation: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        scale: DVec3::ONE,
        turn: Turn::NONE,
    };
}

impl Motion {
    /// A pose that never changes.
    pub fn still(key: Key) -> Self {
        Self { keys: vec![key] }
    }

    /// The keys between which, or beyond which, `time` lies; the same key twice if there is only one.
    pub(crate) fn segment(&self, time: f64) -> (&Key, &Key) {
        match self.keys.as_slice() {
            [] => unreachable!("a motion has at least one key"),
            [key] => (key, key),
            keys => {
                let segment = keys
                    .partition_point(|key| key.time <= time)
                    .clamp(1, keys.len() - 1);
                (&keys[segment - 1], &keys[segment])
            }
        }
    }

    /// From the object's space to its parent's at `time` (frames).
    pub fn at(&self, time: f64) -> DAffine3 {
        let (from, to) = self.segment(time);
        let fraction = if to.time > from.time {
            (time - from.time) / (to.time - from.time)
        } else {
            0.0
        };
        let turn = DQuat::from_axis_angle(from.turn.axis, from.turn.angle * fraction);
        DAffine3::from_scale_rotation_translation(
            from.scale.lerp(to.scale, fraction),
            turn * from.orientation,
            from.translation.lerp(to.translation, fraction),
        )
    }
}
