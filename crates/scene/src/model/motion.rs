//! Motion of an object or a camera, as keys.

use glam::{DQuat, DVec3};

/// A rotation about a fixed axis; more than one turn is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Unit vector.
    pub axis: DVec3,
    /// Radians, right-handed about `axis`.
    pub angle: f64,
}

/// A pose at one time, and the turn to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Frames relative to the instant.
    pub time: f64,
    /// Metres.
    pub translation: DVec3,
    /// Rotation, a unit quaternion.
    pub orientation: DQuat,
    /// Factors per axis, applied before the rotation; never 0.
    pub scale: DVec3,
    /// Rotation from this key to the next, in the parent's axes; unused at the last key.
    pub turn: Turn,
}

/// At least one key, in rising order of time. Before the first key and after the last the motion
/// goes on at the velocity that it has there. A motion of one key stands still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Poses at strictly rising times.
    pub keys: Vec<Key>,
    /// Path between them.
    pub interpolation: Interpolation,
}

/// The path of a motion between keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Interpolation {
    /// Position and scale change at a constant rate, the orientation turns at a constant angular
    /// velocity. Velocities jump at keys.
    #[default]
    Linear,
    /// Velocities are continuous.
    ///
    /// Position and scale follow cubic polynomials. The slope at a key is the slope of the parabola
    /// through the key and its neighbours (Catmull and Rom 1974, for uneven times), so keys taken
    /// from a parabola reproduce it. The angular velocity at a key is the same mean of the turns
    /// before and after it.
    ///
    /// Between keys the orientation is a product of rotations about fixed axes by cubic angles (the
    /// kind of curve of Kim, Kim and Shin 1995): the turn from key to key, with a swing before it
    /// and one after it. A swing vanishes at both keys and supplies the part of the angular
    /// velocity there that is across the turn's axis. Turns that share an axis need no swing.
    Cubic,
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
        Self {
            keys: vec![key],
            ..Self::default()
        }
    }
}
