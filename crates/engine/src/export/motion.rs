//! Motions as keys for glTF: positions and scales exactly, turns to a few millionths of a radian.

use glam::{DQuat, DVec3};
use scene::{Interpolation, Motion};

use crate::export::timeline::{FRAMES_PER_SECOND, Timeline};

/// Largest turn between two keys, in radians: from half a turn on, the shorter way is wrong.
const WIDEST_TURN: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Upper limit on the angle between a turn and its keys' interpolation by components, in radians.
const TOLERANCE: f64 = 1e-6;
/// Upper limit on halvings of the time between two keys.
const MAX_HALVINGS: u32 = 8;
/// Upper limit on the error of a turn by the rounding of its times to 32 bits, in radians.
const TIME_ERROR: f64 = 1e-3;

/// One quantity of a node on its timeline, in glTF's form.
pub struct Track<const N: usize> {
    /// Value at the start.
    pub first: [f32; N],
    /// True if it never changes.
    pub is_still: bool,
    /// Times of keys, in frames relative to the instant.
    pub times: Vec<f64>,
    /// Values at the keys; for cubic curves the slope before the key, per second, the value, and
    /// the slope after it.
    pub values: Vec<[f32; N]>,
    /// Name of the curves between keys.
    pub interpolation: &'static str,
}

/// Position, rotation and scale of a node.
pub struct Tracks {
    /// Metres.
    pub translation: Track<3>,
    /// Unit quaternions, each on the same side as the previous one.
    pub rotation: Track<4>,
    /// Factors per axis.
    pub scale: Track<3>,
}

impl Tracks {
    /// Samples a motion over a timeline; refuses one that turns too fast for 32-bit times.
    pub fn of(motion: &Motion, timeline: &Timeline) -> Result<Self, String> {
        let times = timeline.cut(motion.keys.iter().map(|key| key.time));
        let follow = match motion.interpolation {
            Interpolation::Linear => follow_linear,
            Interpolation::Cubic => follow_cubic,
        };
        let pose = |time: f64| motion.at(time).to_scale_rotation_translation();
        let rotation = |time: f64| pose(time).1.normalize();
        let fastest = |from: f64, to: f64| motion.fastest_turn(from, to);
        check_turns(&times, &fastest)?;
        Ok(Self {
            translation: follow(&times, &|time| pose(time).2),
            rotation: follow_turns(&times, &rotation, &fastest),
            scale: follow(&times, &|time| pose(time).0),
        })
    }
}

/// Refuses a turn that the rounding of its keys' times would put to another angle.
fn check_turns(times: &[f64], fastest: &dyn Fn(f64, f64) -> f64) -> Result<(), String> {
    let frames = times[times.len() - 1] - times[0];
    let speeds = times.windows(2).map(|span| fastest(span[0], span[1]));
    let speed = speeds.fold(0.0, f64::max).to_degrees();
    // A rounded time is wrong by at most half a unit in its 24th binary digit.
    let allowed = (TIME_ERROR / (frames * f64::exp2(-24.0)))
        .to_degrees()
        .floor();
    if speed <= allowed {
        return Ok(());
    }
    Err(format!(
        "turns by up to {speed:.0} degrees per frame; allowed: {allowed}, because glTF's 32-bit times are too \
         coarse for more over {frames} frames; export a scene or variant that turns more slowly"
    ))
}

fn follow_linear(times: &[f64], value: &dyn Fn(f64) -> DVec3) -> Track<3> {
    let values: Vec<DVec3> = times.iter().map(|time| value(*time)).collect();
    Track {
        first: floats(values[0]),
        is_still: values.iter().all(|point| is_close(*point, values[0])),
        times: times.to_vec(),
        values: values.into_iter().map(floats).collect(),
        interpolation: "LINEAR",
    }
}

/// Samples a curve that is a cubic polynomial between each two times: its value at four times gives
/// the slopes at both ends.
fn follow_cubic(times: &[f64], value: &dyn Fn(f64) -> DVec3) -> Track<3> {
    let mut values: Vec<[f32; 3]> = (times.iter())
        .flat_map(|time| [[0.0; 3], floats(value(*time)), [0.0; 3]])
        .collect();
    let per_second = |slope| floats(slope).map(|part| (f64::from(part) * FRAMES_PER_SECOND) as f32);
    let mut is_still = true;
    for next in 1..times.len() {
        let [from, to] = [times[next - 1], times[next]];
        let duration = to - from;
        // The value at a key may belong to the next piece, which has the same value there.
        let [a, b, c, d] = [0.0, 1.0, 2.0, 3.0].map(|third| value(from + duration * third / 3.0));
        is_still &= [b, c, d].iter().all(|point| is_close(*point, a));
        let per_frame = 1.0 / (2.0 * duration);
        let slopes = [
            (-11.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) * per_frame,
            (-2.0 * a + 9.0 * b - 18.0 * c + 11.0 * d) * per_frame,
        ];
        [values[3 * next - 1], values[3 * next]] = slopes.map(per_second);
    }
    Track {
        first: values[1],
        is_still,
        times: times.to_vec(),
        values,
        interpolation: "CUBICSPLINE",
    }
}

/// Samples a turn with keys so dense that players of both kinds show the turn itself: those that go
/// the shorter way at a constant angular velocity, as glTF says, and those that interpolate
/// quaternions by components, as Blender does. Between two times the turn is at most as fast as
/// `fastest` of them, in radians per frame.
fn follow_turns(
    times: &[f64],
    rotation: &dyn Fn(f64) -> DQuat,
    fastest: &dyn Fn(f64, f64) -> f64,
) -> Track<4> {
    let mut keys = vec![(times[0], rotation(times[0]))];
    for span in times.windows(2) {
        let steps = ((span[1] - span[0]) * fastest(span[0], span[1]) / WIDEST_TURN)
            .ceil()
            .max(1.0) as u32;
        let step = (span[1] - span[0]) / f64::from(steps);
        for index in 0..steps {
            let from = span[0] + f64::from(index) * step;
            let to = if index + 1 == steps {
                span[1]
            } else {
                from + step
            };
            refine(rotation, from, to, MAX_HALVINGS, &mut keys);
        }
    }
    for index in 1..keys.len() {
        if keys[index].1.dot(keys[index - 1].1) < 0.0 {
            keys[index].1 = -keys[index].1;
        }
    }
    let turn = |turn: DQuat| turn.as_quat().normalize().to_array();
    let first = keys[0].1;
    let is_first = |(_, rotation): &(f64, DQuat)| rotation.angle_between(first) < TOLERANCE;
    Track {
        first: turn(first),
        is_still: keys.iter().all(is_first),
        times: keys.iter().map(|(time, _)| *time).collect(),
        values: keys.iter().map(|(_, rotation)| turn(*rotation)).collect(),
        interpolation: "LINEAR",
    }
}

/// Adds the keys after `from` up to `to`, more of them where the turn is not steady.
fn refine(
    rotation: &dyn Fn(f64) -> DQuat,
    from: f64,
    to: f64,
    halvings: u32,
    keys: &mut Vec<(f64, DQuat)>,
) {
    let ends = [from, to].map(rotation);
    let strays = [0.25, 0.5, 0.75].into_iter().any(|part| {
        let rotation = rotation(from + part * (to - from));
        rotation.angle_between(ends[0].lerp(ends[1], part)) > TOLERANCE
    });
    if strays && halvings > 0 {
        let middle = 0.5 * (from + to);
        refine(rotation, from, middle, halvings - 1, keys);
        refine(rotation, middle, to, halvings - 1, keys);
    } else {
        keys.push((to, ends[1]));
    }
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

fn is_close(a: DVec3, b: DVec3) -> bool {
    (a - b).abs().max_element() <= 1e-12 * a.abs().max_element().max(1.0)
}
