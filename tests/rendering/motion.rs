//! Motions through keys, against formulas and on both sides of every key.

use frame::Alignment;
use glam::{DAffine3, DQuat, DVec3};
use scene::{Interpolation, Key, Motion, Turn};
use tests::random::Numbers;
use tracer::{TraceError, trace_truth};

use crate::renders::*;

/// Makes a motion through keys at these times, with positions of up to `far` and turns of up to
/// `turn` radians about random axes.
pub fn random_motion(
    numbers: &mut Numbers,
    interpolation: Interpolation,
    times: &[f64],
    [far, turn]: [f64; 2],
) -> Motion {
    let mut orientation = DQuat::IDENTITY;
    let keys = times.iter().map(|&time| {
        let turn = Turn {
            axis: numbers.vector().normalize(),
            angle: turn * numbers.next(),
        };
        let key = Key {
            time,
            translation: far * numbers.vector(),
            orientation,
            scale: DVec3::ONE + 0.5 * numbers.vector(),
            turn,
        };
        orientation = DQuat::from_axis_angle(turn.axis, turn.angle) * orientation;
        key
    });
    Motion {
        keys: keys.collect(),
        interpolation,
    }
}

const TIMES: [f64; 5] = [-1.3, -1.0, 0.0, 0.2, 0.9];
const KINDS: [Interpolation; 2] = [Interpolation::Linear, Interpolation::Cubic];

#[test]
fn keys_on_a_parabola_reproduce_it() {
    let parabola = |time: f64| {
        DVec3::new(1.0, 2.0, 3.0)
            + time * DVec3::new(0.5, -0.7, 0.1)
            + time * time * DVec3::new(0.3, 0.2, 0.4)
    };
    for times in [&[-1.0, 0.5, 0.7][..], &[-1.0, -0.9, 0.0, 0.4, 1.0]] {
        let key = |&time: &f64| Key {
            time,
            translation: parabola(time),
            scale: parabola(time),
            ..Key::REST
        };
        let motion = Motion {
            keys: times.iter().map(key).collect(),
            interpolation: Interpolation::Cubic,
        };
        let (first, last) = (times[0], times[times.len() - 1]);
        for step in 0..=100 {
            let time = first + (last - first) * f64::from(step) / 100.0;
            let pose = motion.at(time);
            // Rounding in 64 bits.
            assert!(pose.translation.distance(parabola(time)) < 1e-13);
            let scale = pose.transform_vector3(DVec3::ONE);
            assert!(scale.distance(parabola(time)) < 1e-13);
        }
    }
}

#[test]
fn turns_about_one_axis_are_cubic_in_angle_for_any_number_of_turns() {
    let axis = DVec3::new(0.48, 0.6, 0.64);
    // Six or more turns between keys, at rising speed.
    let angle = |time: f64| 40.0 * time + 25.0 * time * time;
    let times = [-1.0, 0.0, 0.3, 1.0];
    let key = |(index, &time): (usize, &f64)| Key {
        time,
        orientation: DQuat::from_axis_angle(axis, angle(time)),
        turn: Turn {
            axis,
            angle: times
                .get(index + 1)
                .map_or(0.0, |&next| angle(next) - angle(time)),
        },
        ..Key::REST
    };
    let motion = Motion {
        keys: times.iter().enumerate().map(key).collect(),
        interpolation: Interpolation::Cubic,
    };
    for step in 0..=1000 {
        let time = -1.0 + f64::from(step) / 500.0;
        let expected = DQuat::from_axis_angle(axis, angle(time)) * DVec3::X;
        let actual = motion.at(time).transform_vector3(DVec3::X);
        // Angles up to 65 radians, rounded to 1e-14.
        assert!(actual.distance(expected) < 1e-12, "at {time}");
    }
}

const POINT: DVec3 = DVec3::new(0.3, -0.4, 0.5);

#[test]
fn a_motion_passes_through_its_keys() {
    let mut numbers = Numbers(1 << 32);
    for interpolation in KINDS {
        for turn in [0.5, 3.0] {
            let motion = random_motion(&mut numbers, interpolation, &TIMES, [3.0, turn]);
            for key in &motion.keys {
                let expected = key.orientation * (key.scale * POINT) + key.translation;
                for time in [key.time - 1e-12, key.time] {
                    // 1e-12 frames at speeds of up to 100.
                    let actual = motion.at(time).transform_point3(POINT);
                    let apart = actual.distance(expected);
                    assert!(apart < 1e-9, "{interpolation:?} at {time}");
                }
            }
        }
    }
}

/// Returns the velocity of a point just before and just after a time, in metres per frame.
fn velocities(motion: &Motion, time: f64) -> [DVec3; 2] {
    let at = |time: f64| motion.at(time).transform_point3(POINT);
    [-1e-5, 1e-5]
        .map(|step| (4.0 * at(time + step) - 3.0 * at(time) - at(time + 2.0 * step)) / (2.0 * step))
}

#[test]
fn a_cubic_motion_has_one_velocity_at_each_key_and_a_linear_one_two() {
    let mut numbers = Numbers(2 << 32);
    for turn in [0.0, 0.5, 3.0, 20.0] {
        for _ in 0..10 {
            let [linear, cubic] = KINDS.map(|interpolation| {
                random_motion(&mut numbers, interpolation, &TIMES, [3.0, turn])
            });
            for key in &cubic.keys {
                let [before, after] = velocities(&cubic, key.time);
                // The third derivative, up to 400^3 where 20 radians pass in 0.2 frames, times the
                // squared step.
                let tolerance = 1e-6 + 1e-10 * (turn / 0.05).powi(3);
                assert!(before.distance(after) < tolerance, "{before} and {after}");
            }
            for key in &linear.keys[1..4] {
                let [before, after] = velocities(&linear, key.time);
                assert!(before.distance(after) > 0.1);
            }
        }
    }
}

#[test]
fn a_motion_continues_at_constant_velocity_beyond_its_keys() {
    let mut numbers = Numbers(3 << 32);
    for interpolation in KINDS {
        let mut motion = random_motion(&mut numbers, interpolation, &TIMES, [3.0, 1.0]);
        for key in &mut motion.keys {
            key.scale = DVec3::ONE;
        }
        for [key, then, later] in [[-1.3, -1.5, -1.7], [0.9, 1.1, 1.3]] {
            let [key, then, later] = [key, then, later].map(|time| motion.at(time));
            let step = then.translation - key.translation;
            // Rounding in 64 bits.
            assert!((later.translation - then.translation).distance(step) < 1e-13);
            let turn = |from: DAffine3, to: DAffine3| {
                DQuat::from_mat3(&(to.matrix3 * from.matrix3.transpose()))
            };
            assert!(turn(key, then).angle_between(turn(then, later)) < 1e-7);
        }
    }
}

#[test]
fn a_field_of_view_that_swings_out_of_bounds_between_its_keys_is_refused() {
    let mut scene = empty_scene("zoom");
    scene.camera.motion.interpolation = Interpolation::Cubic;
    let degrees = [(-2.0, 90.0), (-1.0, 1.0), (0.0, 1.0), (1.0, 90.0)];
    let radians = degrees.map(|(time, fov): (f64, f64)| (time, fov.to_radians()));
    scene.camera.vertical_fov = radians.to_vec();
    let settings = settings([4, 4], 256);
    let refused = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched);
    // Slopes of -44.5 and 44.5 degrees per frame: 1 - 44.5 / 4 in the middle.
    let Err(TraceError::FieldOfView { degrees, time, .. }) = refused else {
        panic!("{refused:?}");
    };
    // Rounding in 64 bits.
    let off = [degrees + 10.125, time + 0.5];
    let is_near = off.iter().all(|off| off.abs() < 1e-9);
    assert!(is_near, "{degrees} at {time}");
    // At the instant there is a key.
    render_frame(&scene, &settings);
}
