//! Rigid motion through keys.

use glam::{DAffine3, DQuat, DVec3};

use crate::motion::curve::{Cubic, Keyed};

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
    /// Rotation from this key to the next, in the parent's axes; at the last key it has no meaning.
    pub turn: Turn,
}

/// How a motion goes from one key to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Position and scale change at a constant rate, the orientation turns at a constant angular velocity. Velocities
    /// jump at keys.
    #[default]
    Linear,
    /// Velocities are continuous. Position and scale follow cubic polynomials whose slope at a key is that of the
    /// parabola through the key and its neighbours (Catmull and Rom 1974, for uneven times): keys taken from a parabola
    /// give it back. The angular velocity at a key is the same mean of the turns beside it. Between keys the orientation
    /// is a product of rotations about fixed axes by cubic angles (the kind of curve of Kim, Kim and Shin 1995): the turn
    /// from key to key, and before and after it a swing that vanishes at both keys and makes up for what the angular
    /// velocity there has across the turn's axis. Turns about one axis are cubic angles, however many they are.
    Cubic,
}

/// Keys in rising order of time; at least one. Before the first and after the last key the motion goes on at the
/// velocity that it has there: a motion does not stop because its keys end. A single key stands still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// The poses, times strictly rising.
    pub keys: Vec<Key>,
    /// The way between them.
    pub interpolation: Interpolation,
}

/// A stretch of a motion without keys inside: every part is a polynomial in time.
pub(crate) struct Segment {
    /// The time that the curves count from, in frames.
    pub start: f64,
    pub translation: Cubic<DVec3>,
    pub scale: Cubic<DVec3>,
    /// At the start.
    pub orientation: DQuat,
    pub turn: Turning,
    /// Before and after the turn.
    pub swings: Option<[Turning; 2]>,
}

/// A rotation about a fixed axis.
pub(crate) struct Turning {
    /// Unit vector.
    pub axis: DVec3,
    /// Radians.
    pub angle: Cubic<f64>,
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

    /// From the object's space to its parent's at `time` (frames).
    pub fn at(&self, time: f64) -> DAffine3 {
        self.segment(time).at(time)
    }

    /// The stretch that holds `time`; at a key, the one that begins there.
    pub(crate) fn segment(&self, time: f64) -> Segment {
        self.segment_of(self.keyed().stretch(time))
    }

    /// All stretches: before the first key, and from each key on.
    pub(crate) fn segments(&self) -> impl Iterator<Item = Segment> {
        (0..=self.keys.len()).map(|stretch| self.segment_of(stretch))
    }

    fn keyed(&self) -> Keyed<'_, Key> {
        Keyed {
            keys: &self.keys,
            time: |key: &Key| key.time,
            interpolation: self.interpolation,
        }
    }

    fn segment_of(&self, stretch: usize) -> Segment {
        let keyed = self.keyed();
        let key = |index: usize| &self.keys[index];
        let chord = |part: fn(&Key) -> DVec3| {
            move |from: usize| {
                let [from, to] = [key(from), key(from + 1)];
                (part(to) - part(from)) / (to.time - from.time)
            }
        };
        let curve =
            |part: fn(&Key) -> DVec3| keyed.curve(stretch, |index| part(key(index)), chord(part));
        let anchor = key(keyed.anchor(stretch));
        let (turn, swings) = turning(&keyed, stretch);
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

/// The turn over a stretch, and the swings before and after it.
fn turning(keyed: &Keyed<Key>, stretch: usize) -> (Turning, Option<[Turning; 2]>) {
    let turn = |from: usize| keyed.keys[from].turn;
    let chord = |from: usize| turn(from).angle / keyed.duration(from) * turn(from).axis;
    let from = keyed.anchor(stretch);
    if !keyed.is_between(stretch) || keyed.interpolation == Interpolation::Linear {
        let spin = keyed.slope(from, &chord);
        let angle = Cubic::line(0.0, spin.length());
        return (Turning::about(spin, angle), None);
    }
    let Turn { axis, angle } = turn(from);
    let spins = [from, stretch].map(|key| keyed.slope(key, &chord));
    let along = spins.map(|spin| spin.dot(axis));
    let across = [0, 1].map(|end| spins[end] - along[end] * axis);
    let duration = keyed.duration(from);
    let swing =
        |across: DVec3, slopes| Turning::about(across, Cubic::between([0.0; 2], slopes, duration));
    let swings = [
        swing(across[0], [across[0].length(), 0.0]),
        swing(across[1], [0.0, across[1].length()]),
    ];
    let angle = Cubic::between([0.0, angle], along, duration);
    (Turning { axis, angle }, Some(swings))
}

impl Turning {
    /// About the direction of a vector; where it is zero the angle is to be zero too.
    fn about(direction: DVec3, angle: Cubic<f64>) -> Self {
        let axis = direction.try_normalize().unwrap_or(Turn::NONE.axis);
        Self { axis, angle }
    }

    fn at(&self, since: f64) -> DQuat {
        DQuat::from_axis_angle(self.axis, self.angle.at(since))
    }
}

impl Segment {
    /// The pose at `time` (frames) within the segment.
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

    /// The time that the curves know, from frames.
    pub fn since(&self, time: f64) -> f64 {
        time - self.start
    }

    /// Rotations, each about an axis of its own, in the order in which they are applied.
    pub fn turns(&self) -> impl Iterator<Item = &Turning> {
        let [before, after] = self
            .swings
            .as_ref()
            .map_or([None; 2], |[before, after]| [Some(before), Some(after)]);
        before.into_iter().chain([&self.turn]).chain(after)
    }

    /// Whether nothing changes within it.
    pub fn stands_still(&self) -> bool {
        self.translation.is_constant()
            && self.scale.is_constant()
            && self.turns().all(|turn| turn.angle.is_constant())
    }
}
