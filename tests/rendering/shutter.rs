//! Alignments, gradual shutters and rolling shutters, against closed forms.

use frame::{Alignment, Efficiency, Shutter, ShutterError, ShutterProfile};
use glam::DVec2;
use scene::{Interpolation, Scene};
use tests::half_plane::{area, half_plane};
use tracer::{TraceError, trace_truth};

use crate::moving_shapes::*;
use crate::renders::*;

/// Efficiency, and its formula over the parts of the interval.
type Curve = (Efficiency, fn(f64) -> f64);

const TABLE: [f64; 4] = [0.2, 1.0, 0.0, 0.7];

fn trapezoid(rise: f64, fall: f64) -> Efficiency {
    Efficiency::Trapezoid { rise, fall }
}

fn curves() -> [Curve; 5] {
    [
        (trapezoid(0.3, 0.2), |part| {
            (part / 0.3).min(1.0).min((1.0 - part) / 0.2)
        }),
        (trapezoid(1.0, 0.0), |part| part),
        (trapezoid(0.0, 0.5), |part| (2.0 - 2.0 * part).min(1.0)),
        (trapezoid(0.4, 0.6), |p| (p / 0.4).min((1.0 - p) / 0.6)),
        (Efficiency::Table(TABLE.to_vec()), |part| {
            let step = ((3.0 * part) as usize).min(2);
            let rest = 3.0 * part - step as f64;
            TABLE[step] + rest * (TABLE[step + 1] - TABLE[step])
        }),
    ]
}

/// Returns the mean of `value` over the shutter, weighted by `weight` of the part of the interval.
/// If the weights have corners, the midpoint rule errs by less than 3e-5; standard errors of pixels
/// are above 1e-3.
fn weighted_mean(shutter: Shutter, weight: fn(f64) -> f64, value: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 400;
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
    let along = |time: f64| 2.3 + SPEED * time;
    for (index, (efficiency, weight)) in curves().into_iter().enumerate() {
        let normal = DVec2::from_angle(f64::to_radians([0.0, 30.0][index % 2]));
        let mut scene = half_plane_scene(normal, &[-1.0, 1.0], along);
        let what = efficiency.to_string();
        scene.shutter_profile.efficiency = efficiency;
        let alignment = Alignment::ALL[index % 3];
        expect_coverage(&what, &scene, alignment, |pixel, shutter| {
            weighted_mean(shutter, weight, |time| area(pixel, normal, along(time)))
        });
    }
}

#[test]
fn braking_inside_a_gradual_shutter_follows_its_parabola() {
    let normal = DVec2::from_angle(0.4);
    let parabola = |time: f64| -3.0 - 2.0 * time - 20.0 * time * time;
    let mut scene = half_plane_scene(normal, &[-0.7, -0.5, -0.1, 0.2], parabola);
    scene.objects[0].motion.interpolation = Interpolation::Cubic;
    let [(efficiency, weight), ..] = curves();
    scene.shutter_profile.efficiency = efficiency;
    // Before the first key the motion is a line of the same slope.
    let along = |time: f64| {
        if time < -0.7 {
            parabola(-0.7) + (time + 0.7) * (-2.0 + 40.0 * 0.7)
        } else {
            parabola(time)
        }
    };
    expect_coverage("braking", &scene, Alignment::Trailing, |pixel, shutter| {
        weighted_mean(shutter, weight, |time| area(pixel, normal, along(time)))
    });
}

/// Returns the delay of the row of pixels with this lower border, y up.
fn delay(rolling: f64, bottom: f64) -> f64 {
    -rolling * (bottom + 0.5) / f64::from(HEIGHT)
}

#[test]
fn a_rolling_shutter_shifts_each_row_in_time() {
    for (rolling, alignment, angle) in [
        (0.5, Alignment::Trailing, 0.0),
        (-0.8, Alignment::Leading, 0.8),
    ] {
        let normal = DVec2::from_angle(angle);
        let mut scene = half_plane_scene(normal, &[-1.0, 1.0], |time| 2.3 + SPEED * time);
        scene.shutter_profile.rolling = rolling;
        let what = format!("rolling by {rolling}");
        expect_coverage(&what, &scene, alignment, |pixel, shutter| {
            let offset = 2.3 + SPEED * delay(rolling, pixel.y);
            half_plane(pixel, normal, offset, SPEED, shutter)
        });
    }
}

#[test]
fn sub_frames_lie_at_the_middles_of_equal_parts_of_light() {
    let mut scene = half_plane_scene(DVec2::X, &[-1.0, 1.0], |time| SPEED * time);
    scene.shutter_profile = ShutterProfile {
        efficiency: trapezoid(1.0, 0.0),
        rolling: 0.3,
    };
    let settings = settings([WIDTH, HEIGHT], 1024);
    let truth = render_truth(&scene, &settings, Alignment::Trailing);
    let ladder = render_ladder(&scene, &settings, &truth, &[2]);
    assert_eq!(ladder.shutter_profile, scene.shutter_profile);
    let accumulated = ladder.rungs[0].picture(&truth.mean());
    // Light grows with the square of time: a quarter has passed at half of it, three quarters at
    // the root of that.
    let parts = [0.5, 0.75_f64.sqrt()];
    let row = 3;
    let mut shares = Vec::new();
    for x in 0..WIDTH {
        let corner = pixel_corner(x, row);
        let areas = parts.map(|part| {
            let time = truth.shutter.at(part) + delay(0.3, corner.y);
            area(corner, DVec2::X, SPEED * time)
        });
        let coverage = *accumulated.coverage[1].at(x, row);
        // Pixels on an edge have noise.
        if areas.iter().all(|area| area.fract() == 0.0) {
            let expected = 0.5 * (areas[0] + areas[1]);
            // Noise of the truth and of the whole shutter that the rung is a difference from: at
            // most 0.012 each for a share of a half, by 1,024 samples. Four standard deviations of
            // both.
            expect_near(&format!("column {x}"), coverage.into(), expected, 0.07);
        }
        shares.push(coverage);
    }
    let is_half = |coverage: &f32| (coverage - 0.5).abs() < 0.07;
    assert!(
        shares.iter().any(is_half),
        "none lies between them: {shares:?}"
    );
}

#[test]
fn motion_while_only_late_rows_are_open_counts() {
    let along = |time: f64| 30.0 * time.max(0.0);
    let mut scene = half_plane_scene(DVec2::X, &[-1.0, 0.0, 0.2], along);
    let moves = |scene: &Scene| {
        let truth = render_truth(scene, &settings([WIDTH, HEIGHT], 16), Alignment::Trailing);
        truth.motion.pixels.iter().any(|motion| *motion > 0.0)
    };
    assert!(!moves(&scene));
    scene.shutter_profile.rolling = 0.4;
    assert!(moves(&scene));
}

#[test]
fn invalid_shutters_are_refused() {
    let table = |values: &[f64]| Efficiency::Table(values.to_vec());
    let ramps = |rise, fall| ShutterError::Ramps { rise, fall };
    let infinite = f64::INFINITY;
    for (efficiency, error) in [
        (trapezoid(0.6, 0.5), ramps(0.6, 0.5)),
        (trapezoid(-0.1, 0.5), ramps(-0.1, 0.5)),
        (table(&[]), ShutterError::Table(0)),
        (table(&[1.0]), ShutterError::Table(1)),
        (table(&[1.0, -0.5]), ShutterError::Efficiency(-0.5)),
        (table(&[1.0, infinite]), ShutterError::Efficiency(infinite)),
        (table(&[0.0, 0.0]), ShutterError::Dark),
    ] {
        let mut scene = half_plane_scene(DVec2::X, &[-1.0, 1.0], |time| time);
        scene.shutter_profile.efficiency = efficiency;
        let refused = trace_truth(&scene, &truth_settings(), Alignment::Trailing, &unwatched);
        assert_eq!(refused, Err(TraceError::Shutter(error)));
    }
    let nan = f64::NAN;
    for never in [trapezoid(nan, 0.0), trapezoid(0.0, nan), table(&[1.0, nan])] {
        assert!(never.check().is_err(), "{never}");
    }
    let (rolling, efficiency) = (-infinite, Efficiency::Box);
    let profile = ShutterProfile {
        efficiency,
        rolling,
    };
    assert_eq!(profile.check(), Err(ShutterError::Rolling(-infinite)));
    let reversed = Shutter::new(0.75, 0.25).unwrap_err().to_string();
    assert!(reversed.starts_with("shutter closes at 0.25 before it opens at 0.75"));
    for exposure in [0.0, -0.5, nan, infinite] {
        let refused = Alignment::Leading.shutter(exposure).unwrap_err();
        let allowed = "allowed: above 0 and finite";
        assert!(refused.to_string().contains(allowed), "{refused}");
    }
}

#[test]
fn alignments_place_the_shutter_around_the_instant() {
    let expected = [[-0.5, 0.0], [-0.25, 0.25], [0.0, 0.5]];
    for (alignment, expected) in Alignment::ALL.into_iter().zip(expected) {
        let shutter = alignment.shutter(0.5).expect("allowed");
        assert_eq!([shutter.open, shutter.close], expected, "{alignment}");
    }
}
