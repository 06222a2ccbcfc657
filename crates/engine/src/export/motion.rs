//! Motions as keys that glTF interpolates: positions and scales exactly, turns to a millionth of a radian.

use glam::{DQuat, DVec3};
use tracer::{Interpolation, Motion};

use crate::export::timeline::Timeline;

/// Largest turn between two keys, in radians: from half a turn on, the shorter way is the wrong one.
const WIDEST_TURN: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Upper limit of the angle between a turn and its keys' interpolation, in radians.
const TOLERANCE: f64 = 1e-6;
/// Upper limit on halvings of the time between two keys.
const MOST_HALVINGS: u32 = 12;
/// A cubic curve is at most this many times as fast as its fastest chord: the bound of a Hermite curve whose slopes are means of
/// chords, or at an end twice a chord less such a mean.
const OVER_CHORD: f64 = 6.0;

/// Values of one quantity at the times of keys.
#[derive(Clone, Debug, PartialEq)]
pub enum Track<T> {
    /// The quantity never changes.
    Still(T),
    /// Linear between keys: time in frames, and value.
    Linear(Vec<(f64, T)>),
    /// Cubic Hermite curves between keys.
    Cubic(Vec<CubicKey<T>>),
}

/// A key of a cubic curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicKey<T> {
    /// Frames relative to the instant.
    pub time: f64,
    /// Slope before the key, per frame.
    pub slope_in: T,
    /// Value.
    pub value: T,
    /// Slope after the key, per frame.
    pub slope_out: T,
}

/// Place, turn and scale of a node.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracks {
    /// Metres.
    pub translation: Track<DVec3>,
    /// Unit quaternions, each on the same side as the one before.
    pub rotation: Track<DQuat>,
    /// Factors per axis.
    pub scale: Track<DVec3>,
}

impl Tracks {
    /// Follows a motion through a timeline.
    pub fn of(motion: &Motion, timeline: &Timeline) -> Self {
        let times = timeline.cut(motion.keys.iter().map(|key| key.time));
        let is_cubic = motion.interpolation == Interpolation::Cubic;
        let follow = |part: fn(Pose) -> DVec3| {
            let value = |time: f64| part(Pose::of(motion, time));
            match is_cubic {
                true => follow_cubic(&times, value),
                false => follow_linear(&times, value),
            }
        };
        Self {
            translation: follow(|pose| pose.translation),
            rotation: follow_turns(motion, &times),
            scale: follow(|pose| pose.scale),
        }
    }
}

/// A pose, taken apart.
struct Pose {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
}

impl Pose {
    fn of(motion: &Motion, time: f64) -> Self {
        let (scale, rotation, translation) = motion.at(time).to_scale_rotation_translation();
        Self {
            translation,
            rotation: rotation.normalize(),
            scale,
        }
    }
}

fn follow_linear(times: &[f64], value: impl Fn(f64) -> DVec3) -> Track<DVec3> {
    let keys: Vec<(f64, DVec3)> = times.iter().map(|time| (*time, value(*time))).collect();
    match keys.iter().all(|(_, own)| is_close(*own, keys[0].1)) {
        true => Track::Still(keys[0].1),
        false => Track::Linear(keys),
    }
}

/// Follows a curve that is a cubic polynomial between each two times: its value at four times gives the slopes at both ends.
fn follow_cubic(times: &[f64], value: impl Fn(f64) -> DVec3) -> Track<DVec3> {
    let mut keys: Vec<CubicKey<DVec3>> = (times.iter())
        .map(|time| CubicKey {
            time: *time,
            slope_in: DVec3::ZERO,
            value: value(*time),
            slope_out: DVec3::ZERO,
        })
        .collect();
    let mut is_still = true;
    for next in 1..keys.len() {
        let [from, to] = [keys[next - 1].time, keys[next].time];
        let duration = to - from;
        // The value at a key may belong to the piece after it, which has the same value there.
        let [a, b, c, d] = [0.0, 1.0, 2.0, 3.0].map(|third| value(from + duration * third / 3.0));
        is_still &= [b, c, d].iter().all(|own| is_close(*own, a));
        let per_frame = 1.0 / (2.0 * duration);
        keys[next - 1].slope_out = (-11.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) * per_frame;
        keys[next].slope_in = (-2.0 * a + 9.0 * b - 18.0 * c + 11.0 * d) * per_frame;
    }
    match is_still {
        true => Track::Still(keys[0].value),
        false => Track::Cubic(keys),
    }
}

/// Follows a turn by keys between which the shorter way at a constant angular velocity is the turn's own.
fn follow_turns(motion: &Motion, times: &[f64]) -> Track<DQuat> {
    let rotation = |time: f64| Pose::of(motion, time).rotation;
    let fastest = fastest_turn(motion);
    let mut keys = vec![(times[0], rotation(times[0]))];
    for span in times.windows(2) {
        let steps = ((span[1] - span[0]) * fastest / WIDEST_TURN)
            .ceil()
            .max(1.0) as u32;
        let step = (span[1] - span[0]) / f64::from(steps);
        for index in 0..steps {
            let from = span[0] + f64::from(index) * step;
            let to = match index + 1 == steps {
                true => span[1],
                false => from + step,
            };
            refine(&rotation, from, to, MOST_HALVINGS, &mut keys);
        }
    }
    for index in 1..keys.len() {
        if keys[index].1.dot(keys[index - 1].1) < 0.0 {
            keys[index].1 = -keys[index].1;
        }
    }
    let first = keys[0].1;
    match keys
        .iter()
        .all(|(_, own)| own.angle_between(first) < TOLERANCE)
    {
        true => Track::Still(first),
        false => Track::Linear(keys),
    }
}

/// Adds the keys after `from` up to `to`, more of them where the turn is not steady.
fn refine(
    rotation: &impl Fn(f64) -> DQuat,
    from: f64,
    to: f64,
    halvings: u32,
    keys: &mut Vec<(f64, DQuat)>,
) {
    let ends = [from, to].map(rotation);
    let strays = [0.25, 0.5, 0.75].into_iter().any(|part| {
        let own = rotation(from + part * (to - from));
        own.angle_between(ends[0].slerp(ends[1], part)) > TOLERANCE
    });
    if strays && halvings > 0 {
        let middle = 0.5 * (from + to);
        refine(rotation, from, middle, halvings - 1, keys);
        refine(rotation, middle, to, halvings - 1, keys);
    } else {
        keys.push((to, ends[1]));
    }
}

/// Returns an upper limit of the angular velocity, in radians per frame.
fn fastest_turn(motion: &Motion) -> f64 {
    let chords = motion.keys.windows(2).map(|pair| {
        let [from, to] = [&pair[0], &pair[1]];
        from.turn.angle.abs() / (to.time - from.time)
    });
    let fastest = chords.fold(0.0, f64::max);
    match motion.interpolation {
        Interpolation::Linear => fastest,
        Interpolation::Cubic => OVER_CHORD * fastest,
    }
}

fn is_close(a: DVec3, b: DVec3) -> bool {
    (a - b).abs().max_element() <= 1e-12 * a.abs().max_element().max(1.0)
}
