//! Alignments, gradual shutters and rolling shutters, against closed forms.

use frame::{Alignment, Efficiency, Shutter, ShutterError, ShutterProfile};
use glam::{DQuat, DVec2, DVec3};
use tests::half_plane::{area, half_plane};
use tests::shapes::*;
use tests::unwatched;
use tracer::{
    Interpolation, Key, Motion, Scene, TraceError, replicate_hash, trace_ladder, trace_truth,
};

use crate::moving_shapes::{
    DISTANCE, HEIGHT, SPEED, WIDTH, expect_coverage, pixel_corner, render_truth, truth_settings,
};

/// Makes a white half-plane on black whose edge lies `along(t)` pixels from the centre in the direction of `normal`.
fn half_plane_scene(normal: DVec2, times: &[f64], along: impl Fn(f64) -> f64) -> Scene {
    let mut scene = empty_scene("shutter");
    let key = |&time: &f64| {
        let place = (along(time) - 200.0) * normal;
        Key {
            time,
            translation: DVec3::new(place.x, place.y, -DISTANCE),
            orientation: DQuat::from_rotation_z(normal.to_angle()),
            ..Key::REST
        }
    };
    let motion = Motion {
        keys: times.iter().map(key).collect(),
        interpolation: Interpolation::Cubic,
    };
    add(&mut scene, rectangle(400.0, 400.0), glowing(1.0), motion);
    scene
}

/// Efficiency, and its formula over the parts of the interval.
type Curve = (Efficiency, fn(f64) -> f64);

const TABLE: [f64; 4] = [0.2, 1.0, 0.0, 0.7];

fn curves() -> Vec<Curve> {
    let trapezoid = |rise, fall| Efficiency::Trapezoid { rise, fall };
    vec![
        (trapezoid(0.3, 0.2), |part| {
            (part / 0.3).min(1.0).min((1.0 - part) / 0.2)
        }),
        (trapezoid(1.0, 0.0), |part| part),
        (trapezoid(0.0, 0.5), |part| (2.0 - 2.0 * part).min(1.0)),
        (trapezoid(0.4, 0.6), |part| {
            (part / 0.4).min((1.0 - part) / 0.6)
        }),
        (Efficiency::Table(TABLE.to_vec()), |part| {
            let step = ((3.0 * part) as usize).min(2);
            let rest = 3.0 * part - step as f64;
            TABLE[step] + rest * (TABLE[step + 1] - TABLE[step])
        }),
    ]
}

/// Returns the mean of `value` over the shutter, weighted by `weight` of the part of the interval. The midpoint rule
/// errs by less than 1e-7 where the weights have corners.
fn weighted_mean(shutter: Shutter, weight: fn(f64) -> f64, value: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 6000;
    let (mut sum, mut total) = (0.0, 0.0);
    for step in 0..STEPS {
        let part = (f64::from(step) + 0.5) / f64::from(STEPS);
        sum += weight(part) * value(shutter.at(part));
        total += weight(part);
    }
    sum / total
}

#[test]
fn a_ramp_is_the_integral_of_the_efficiency() {
    for (efficiency, weight) in curves() {
        for (alignment, degrees) in [(Alignment::Trailing, 0.0), (Alignment::Centred, 30.0)] {
            let normal = DVec2::from_angle(f64::to_radians(degrees));
            let along = |time: f64| 2.3 + SPEED * time;
            let mut scene = half_plane_scene(normal, &[-1.0, 1.0], along);
            scene.shutter_profile.efficiency = efficiency.clone();
            let truth = render_truth(&scene, alignment);
            let shutter = truth.shutter;
            expect_coverage(&format!("{efficiency}, {alignment}"), &truth, |x, y| {
                weighted_mean(shutter, weight, |time| {
                    area(pixel_corner(x, y), normal, along(time))
                })
            });
        }
    }
}

#[test]
fn braking_inside_a_gradual_shutter_follows_its_parabola() {
    let normal = DVec2::from_angle(0.4);
    let along = |time: f64| -3.0 - 2.0 * time - 20.0 * time * time;
    for (efficiency, weight) in [
        (Efficiency::Box, (|_| 1.0) as fn(f64) -> f64),
        curves()[0].clone(),
    ] {
        let mut scene = half_plane_scene(normal, &[-0.7, -0.5, -0.1, 0.2], along);
        scene.shutter_profile.efficiency = efficiency;
        let truth = render_truth(&scene, Alignment::Trailing);
        // Before the first key the motion is a line of the same slope.
        let along = |time: f64| match time < -0.7 {
            true => along(-0.7) + (time + 0.7) * (-2.0 + 40.0 * 0.7),
            false => along(time),
        };
        expect_coverage("braking", &truth, |x, y| {
            weighted_mean(truth.shutter, weight, |time| {
                area(pixel_corner(x, y), normal, along(time))
            })
        });
    }
}

#[test]
fn a_rolling_shutter_shifts_each_row_in_time() {
    for rolling in [0.5, -0.8] {
        for (alignment, degrees) in [(Alignment::Trailing, 0.0), (Alignment::Leading, 45.0)] {
            let normal = DVec2::from_angle(f64::to_radians(degrees));
            let mut scene = half_plane_scene(normal, &[-1.0, 1.0], |time| 2.3 + SPEED * time);
            scene.shutter_profile.rolling = rolling;
            let truth = render_truth(&scene, alignment);
            expect_coverage(
                &format!("rolling by {rolling}, {alignment}"),
                &truth,
                |x, y| {
                    let later = rolling * ((f64::from(y) + 0.5) / f64::from(HEIGHT) - 0.5);
                    let offset = 2.3 + SPEED * later;
                    half_plane(pixel_corner(x, y), normal, offset, SPEED, truth.shutter)
                },
            );
        }
    }
}

#[test]
fn sub_frames_lie_at_the_middles_of_equal_parts_of_light() {
    let mut scene = half_plane_scene(DVec2::X, &[-1.0, 1.0], |time| SPEED * time);
    scene.shutter_profile = ShutterProfile {
        efficiency: Efficiency::Trapezoid {
            rise: 1.0,
            fall: 0.0,
        },
        rolling: 0.3,
    };
    let truth = render_truth(&scene, Alignment::Trailing);
    let ladder =
        trace_ladder(&scene, &truth_settings(), &truth, &[2], &unwatched).expect("allowed");
    assert_eq!(ladder.shutter_profile, scene.shutter_profile);
    // Light grows with the square of time: a quarter has passed at half of it, three quarters at the root of that.
    let parts = [0.5, 0.75_f64.sqrt()];
    let row = 3;
    let later = 0.3 * ((f64::from(row) + 0.5) / f64::from(HEIGHT) - 0.5);
    let found = &ladder.rungs[0].halves[0].coverage[1];
    for x in 0..WIDTH {
        let areas = parts.map(|part| {
            let time = truth.shutter.at(part) + later;
            area(pixel_corner(x, row), DVec2::X, SPEED * time)
        });
        // Pixels on an edge have noise.
        if areas.iter().all(|area| area.fract() == 0.0) {
            assert_eq!(
                f64::from(*found.at(x, row)),
                0.5 * (areas[0] + areas[1]),
                "column {x}"
            );
        }
    }
    let steps: Vec<f32> = (0..WIDTH).map(|x| *found.at(x, row)).collect();
    assert!(
        steps.contains(&0.5),
        "no column lies between the sub-frames: {steps:?}"
    );
}

#[test]
fn motion_while_only_late_rows_are_open_counts() {
    let along = |time: f64| 30.0 * time.max(0.0);
    let mut scene = half_plane_scene(DVec2::X, &[-1.0, 0.0, 0.2], along);
    scene.objects[0].motion.interpolation = Interpolation::Linear;
    let moves = |scene: &Scene| {
        render_truth(scene, Alignment::Trailing)
            .motion
            .pixels
            .iter()
            .any(|m| *m > 0.0)
    };
    assert!(!moves(&scene));
    scene.shutter_profile.rolling = 0.4;
    assert!(moves(&scene));
}

#[test]
fn the_hash_of_a_truth_depends_on_its_shutter() {
    let scene = half_plane_scene(DVec2::X, &[-1.0, 1.0], |time| time);
    let hash = |change: fn(&mut ShutterProfile)| {
        let mut scene = scene.clone();
        change(&mut scene.shutter_profile);
        replicate_hash(&scene, &truth_settings(), Alignment::Trailing)
    };
    let plain = hash(|_| ());
    assert_ne!(plain, hash(|profile| profile.rolling = 0.1));
    assert_ne!(
        plain,
        hash(|profile| profile.efficiency = Efficiency::Table(vec![1.0, 1.0]))
    );
}

#[test]
fn invalid_shutters_are_refused() {
    let trapezoid = |rise, fall| Efficiency::Trapezoid { rise, fall };
    let table = |values: &[f64]| Efficiency::Table(values.to_vec());
    for (efficiency, error) in [
        (
            trapezoid(0.6, 0.5),
            ShutterError::Ramps {
                rise: 0.6,
                fall: 0.5,
            },
        ),
        (
            trapezoid(-0.1, 0.5),
            ShutterError::Ramps {
                rise: -0.1,
                fall: 0.5,
            },
        ),
        (table(&[]), ShutterError::Table(0)),
        (table(&[1.0]), ShutterError::Table(1)),
        (table(&[1.0, -0.5]), ShutterError::Efficiency(-0.5)),
        (
            table(&[1.0, f64::INFINITY]),
            ShutterError::Efficiency(f64::INFINITY),
        ),
        (table(&[0.0, 0.0]), ShutterError::Dark),
    ] {
        let mut scene = half_plane_scene(DVec2::X, &[-1.0, 1.0], |time| time);
        scene.shutter_profile.efficiency = efficiency;
        let found =
            trace_truth(&scene, &truth_settings(), Alignment::Trailing, &unwatched).unwrap_err();
        assert_eq!(found, TraceError::Shutter(error));
    }
    for never in [
        trapezoid(f64::NAN, 0.0),
        trapezoid(0.0, f64::NAN),
        table(&[1.0, f64::NAN]),
    ] {
        assert!(never.check().is_err(), "{never}");
    }
    let rolling = f64::NEG_INFINITY;
    let profile = ShutterProfile {
        rolling,
        ..ShutterProfile::default()
    };
    assert_eq!(profile.check(), Err(ShutterError::Rolling(rolling)));
}

#[test]
fn a_shutter_that_closes_before_it_opens_is_refused() {
    let message = Shutter::new(0.75, 0.25).unwrap_err().to_string();
    assert!(
        message.starts_with("shutter closes at 0.25 before it opens at 0.75"),
        "{message}"
    );
    for exposure in [0.0, -0.5, f64::NAN, f64::INFINITY] {
        let message = Alignment::Leading
            .shutter(exposure)
            .unwrap_err()
            .to_string();
        assert!(message.contains("allowed: above 0 and finite"), "{message}");
    }
}

#[test]
fn alignments_place_the_shutter_around_the_instant() {
    let interval = |alignment: Alignment| {
        let shutter = alignment.shutter(0.5).unwrap();
        (shutter.open, shutter.close)
    };
    assert_eq!(interval(Alignment::Trailing), (-0.5, 0.0));
    assert_eq!(interval(Alignment::Centred), (-0.25, 0.25));
    assert_eq!(interval(Alignment::Leading), (0.0, 0.5));
}
