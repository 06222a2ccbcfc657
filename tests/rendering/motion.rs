//! Motions through keys, against formulas and on both sides of every key.

use frame::Alignment;
use glam::{DQuat, DVec3};
use tests::random::hash;
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Interpolation, Key, Motion, RenderSettings, TraceError, Turn, trace_frame, trace_truth,
};

/// Draws a number in [-1, 1) from a counter.
fn draw_number(counter: &mut u64) -> f64 {
    *counter += 1;
    (hash(*counter) >> 11) as f64 / 2f64.powi(52) - 1.0
}

fn draw_vector(counter: &mut u64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| draw_number(counter)))
}

/// Makes a motion through keys at uneven times, with turns of up to `turn` radians about random axes.
fn random_motion(counter: &mut u64, interpolation: Interpolation, turn: f64) -> Motion {
    let mut orientation = DQuat::IDENTITY;
    let keys = [-1.3, -1.0, 0.0, 0.2, 0.9].map(|time| {
        let turn = Turn {
            axis: draw_vector(counter).normalize(),
            angle: turn * draw_number(counter),
        };
        let key = Key {
            time,
            translation: 3.0 * draw_vector(counter),
            orientation,
            scale: DVec3::ONE + 0.5 * draw_vector(counter),
            turn,
        };
        orientation = DQuat::from_axis_angle(turn.axis, turn.angle) * orientation;
        key
    });
    Motion {
        keys: keys.to_vec(),
        interpolation,
    }
}

/// Makes a motion through keys at given times, with known translations and scales.
fn keys(times: &[f64], place: impl Fn(f64) -> DVec3, scale: impl Fn(f64) -> DVec3) -> Motion {
    Motion {
        keys: times
            .iter()
            .map(|&time| Key {
                time,
                translation: place(time),
                scale: scale(time),
                ..Key::REST
            })
            .collect(),
        interpolation: Interpolation::Cubic,
    }
}

#[test]
fn keys_on_a_parabola_reproduce_it() {
    let parabola = |time: f64| {
        DVec3::new(1.0, 2.0, 3.0)
            + time * DVec3::new(0.5, -0.7, 0.1)
            + time * time * DVec3::new(0.3, 0.2, 0.4)
    };
    for times in [&[-1.0, 0.5, 0.7][..], &[-1.0, -0.9, 0.0, 0.4, 1.0]] {
        let motion = keys(times, parabola, parabola);
        let (first, last) = (times[0], times[times.len() - 1]);
        for step in 0..=100 {
            let time = first + (last - first) * f64::from(step) / 100.0;
            let found = motion.at(time);
            let scale = found.matrix3.to_cols_array_2d();
            // Rounding in 64 bits.
            assert!(found.translation.distance(parabola(time)) < 1e-13);
            assert!(
                DVec3::new(scale[0][0], scale[1][1], scale[2][2]).distance(parabola(time)) < 1e-13
            );
        }
    }
}

#[test]
fn turns_about_one_axis_are_cubic_in_angle_for_any_number_of_turns() {
    let axis = DVec3::new(0.48, 0.6, 0.64);
    // Six or more turns between keys, at rising speed.
    let angle = |time: f64| 40.0 * time + 25.0 * time * time;
    let times = [-1.0, 0.0, 0.3, 1.0];
    let motion = Motion {
        keys: times
            .iter()
            .enumerate()
            .map(|(index, &time)| Key {
                time,
                orientation: DQuat::from_axis_angle(axis, angle(time)),
                turn: Turn {
                    axis,
                    angle: times
                        .get(index + 1)
                        .map_or(0.0, |&next| angle(next) - angle(time)),
                },
                ..Key::REST
            })
            .collect(),
        interpolation: Interpolation::Cubic,
    };
    for step in 0..=1000 {
        let time = -1.0 + f64::from(step) / 500.0;
        let expected = DQuat::from_axis_angle(axis, angle(time)) * DVec3::X;
        // Angles up to 65 radians, rounded to 1e-14.
        assert!(
            motion
                .at(time)
                .transform_vector3(DVec3::X)
                .distance(expected)
                < 1e-12,
            "at {time}"
        );
    }
}

#[test]
fn a_motion_passes_through_its_keys() {
    let mut counter = 1 << 32;
    for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
        for turn in [0.5, 3.0] {
            let motion = random_motion(&mut counter, interpolation, turn);
            for key in &motion.keys {
                let point = DVec3::new(0.3, -0.4, 0.5);
                let expected = key.orientation * (key.scale * point) + key.translation;
                for time in [key.time - 1e-12, key.time] {
                    // 1e-12 frames at speeds of up to 100.
                    let found = motion.at(time).transform_point3(point);
                    assert!(
                        found.distance(expected) < 1e-9,
                        "{interpolation:?} at {time}"
                    );
                }
            }
        }
    }
}

/// Returns the velocity of a point just before and just after a time, in metres per frame.
fn velocities(motion: &Motion, time: f64) -> [DVec3; 2] {
    let at = |time: f64| motion.at(time).transform_point3(DVec3::new(0.3, -0.4, 0.5));
    [-1e-5, 1e-5]
        .map(|step| (4.0 * at(time + step) - 3.0 * at(time) - at(time + 2.0 * step)) / (2.0 * step))
}

#[test]
fn a_cubic_motion_has_one_velocity_at_each_key_and_a_linear_one_two() {
    let mut counter = 2 << 32;
    for turn in [0.0, 0.5, 3.0, 20.0] {
        for _ in 0..10 {
            let [cubic, linear] = [Interpolation::Cubic, Interpolation::Linear]
                .map(|interpolation| random_motion(&mut counter, interpolation, turn));
            for key in &cubic.keys {
                let [before, after] = velocities(&cubic, key.time);
                // The third derivative, up to 400^3 where 20 radians pass in 0.2 frames, times the squared step.
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
    let mut counter = 3 << 32;
    for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
        let mut motion = random_motion(&mut counter, interpolation, 1.0);
        for key in &mut motion.keys {
            key.scale = DVec3::ONE;
        }
        for [key, then, later] in [[-1.3, -1.5, -1.7], [0.9, 1.1, 1.3]] {
            let [key, then, later] = [key, then, later].map(|time| motion.at(time));
            let step = then.translation - key.translation;
            // Rounding in 64 bits.
            assert!((later.translation - then.translation).distance(step) < 1e-13);
            let turn = |from: glam::DAffine3, to: glam::DAffine3| {
                DQuat::from_mat3(&(to.matrix3 * from.matrix3.transpose()))
            };
            assert!(turn(key, then).angle_between(turn(then, later)) < 1e-7);
        }
    }
}

#[test]
fn a_field_of_view_that_swings_out_of_bounds_between_its_keys_is_refused() {
    let mut scene = empty_scene("zoom");
    add(
        &mut scene,
        rectangle(1.0, 1.0),
        glowing(1.0),
        placed(DVec3::NEG_Z),
    );
    scene.camera.motion.interpolation = Interpolation::Cubic;
    let degrees = [(-2.0, 90.0), (-1.0, 1.0), (0.0, 1.0), (1.0, 90.0)];
    scene.camera.vertical_fov = degrees
        .map(|(time, fov): (f64, f64)| (time, fov.to_radians()))
        .to_vec();
    let settings = RenderSettings {
        width: 4,
        height: 4,
        ..RenderSettings::default()
    };
    let error = trace_truth(&scene, &settings, Alignment::Trailing, &unwatched).unwrap_err();
    // Slopes of -44.5 and 44.5 degrees per frame: 1 - 44.5 / 4 in the middle.
    let TraceError::FieldOfView { degrees, time, .. } = error else {
        panic!("{error}");
    };
    // Rounding in 64 bits.
    assert!(
        (degrees + 10.125).abs() < 1e-9 && (time + 0.5).abs() < 1e-9,
        "{degrees} at {time}"
    );
    trace_frame(&scene, &settings, &unwatched).expect("at the instant there is a key");
}
