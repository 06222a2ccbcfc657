//! Places at the instant, and parts that no frame can know.

use std::f64::consts::{FRAC_PI_2, PI};

use frame::{Alignment, AtInstant};
use glam::DVec3;
use tests::shapes::*;
use tracer::{Key, Motion, Turn};

use super::{
    DISTANCE, EXPOSURE, HEIGHT, SPEED, STEP_ERROR, WIDTH, for_each_column, mean_over,
    panel_over_wall, render_truth,
};

#[test]
fn uncovered_background_and_pixels_beyond_the_border_are_unknowable() {
    // In the middle, and reaching over the right border; far from the wall and very near it.
    for (gap, at, half) in [(2.0, 0.0, 5.0), (2.0, 13.0, 8.0), (1e-5, 0.0, 5.0)] {
        for alignment in Alignment::ALL {
            let truth = render_truth(&panel_over_wall(gap, at, 2.0 * half as f32), alignment);
            let known = truth.at_instant_mean();
            for_each_column(|left, pixel| {
                let expected = mean_over(left, alignment, |x, t| {
                    let covered = |x: f64, t: f64| (x - at - SPEED * t).abs() < half;
                    let unknown = if covered(x, t) {
                        // The place of the panel's point at the instant.
                        (x - SPEED * t).abs() > 0.5 * f64::from(WIDTH)
                    } else {
                        covered(x, 0.0)
                    };
                    f64::from(unknown)
                });
                let found = f64::from(known.unknowable.pixels[pixel]);
                assert!(
                    (found - expected).abs() < STEP_ERROR,
                    "{alignment}, panel at {at}, column {left}: {found} is unknowable, not {expected}"
                );
            });
        }
    }
}

#[test]
fn a_sliding_panel_s_samples_come_from_its_whole_way() {
    for alignment in Alignment::ALL {
        // Wider than the picture and its motion together.
        let truth = render_truth(&panel_over_wall(2.0, 0.0, 90.0), alignment);
        let mean = truth.at_instant_mean();
        for_each_column(|left, pixel| {
            let shutter = alignment.shutter(EXPOSURE).unwrap();
            let [open, close] = [shutter.open, shutter.close].map(|t| -SPEED * t);
            let offset = 0.5 * (open + close);
            // The mean square of a number that is uniform between two others, and of the place in the pixel.
            let spread = (open * open + open * close + close * close) / 3.0 + 1.0 / 12.0;
            assert_eq!(mean.placed.pixels[pixel], 1.0);
            let [x, y] = mean.offset.pixels[pixel].map(f64::from);
            let [xx, xy, yy] = mean.spread.pixels[pixel].map(f64::from);
            // Stratified samples of smooth functions: 1/1024 of the range is several times their error.
            let error = SPEED * EXPOSURE / 1024.0;
            assert!(
                (x - offset).abs() < error && y.abs() < error,
                "{alignment} {left}: {x} {y}"
            );
            assert!(
                (xx - spread).abs() < 2.0 * SPEED * EXPOSURE * error,
                "{alignment}: {xx} {spread}"
            );
            assert!(
                xy.abs() < 0.05 && (yy - 1.0 / 12.0).abs() < error,
                "{alignment}: {xy} {yy}"
            );
        });
    }
}

#[test]
fn the_other_side_of_a_sheet_is_unknowable() {
    let mut scene = empty_scene("sheet");
    let turn = Turn {
        axis: DVec3::Y,
        angle: PI / EXPOSURE,
    };
    let at = |time| Key {
        time,
        translation: DVec3::new(0.0, 0.0, -DISTANCE),
        turn,
        ..Key::REST
    };
    let motion = Motion {
        keys: vec![
            at(0.0),
            Key {
                time: 1.0,
                ..at(0.0)
            },
        ],
        ..Motion::default()
    };
    add(&mut scene, rectangle(8.0, 8.0), glowing(1.0), motion);
    let known: AtInstant = render_truth(&scene, Alignment::Trailing).at_instant_mean();
    // The ray through `x` meets the sheet, turned by `angle`, at this distance from its axis.
    let met = |x: f64, angle: f64| DISTANCE * x / (DISTANCE * angle.cos() + x * angle.sin());
    let front = |x: f64, t: f64| {
        let angle = PI / EXPOSURE * t;
        f64::from(angle.abs() < FRAC_PI_2 && met(x, angle).abs() < 4.0)
    };
    // The axis lies between two pixels. Their mean does not depend on which of them sees the sheet's nearer half.
    let expected = 1.0
        - [0.0, -1.0]
            .map(|left| mean_over(left, Alignment::Trailing, front))
            .iter()
            .sum::<f64>()
            / 2.0;
    let centre = (HEIGHT / 2 * WIDTH + WIDTH / 2) as usize;
    let found = [centre, centre - 1]
        .map(|pixel| f64::from(known.unknowable.pixels[pixel]))
        .iter()
        .sum::<f64>()
        / 2.0;
    assert!(
        (found - expected).abs() < STEP_ERROR,
        "{found}, not {expected}"
    );
}

#[test]
fn points_behind_the_camera_have_no_place() {
    let mut scene = empty_scene("pan");
    let rate = 2.0;
    scene.camera.motion = spin(DVec3::ZERO, DVec3::Y, rate);
    let known = render_truth(&scene, Alignment::Trailing).at_instant_mean();
    for_each_column(|left, pixel| {
        // The view turns left: earlier views lie to the right, and behind the camera beyond a right angle.
        let expected = mean_over(left, Alignment::Trailing, |x, t| {
            f64::from((x / DISTANCE).atan() - rate * t < FRAC_PI_2)
        });
        let found = f64::from(known.placed.pixels[pixel]);
        assert!(
            (found - expected).abs() < STEP_ERROR,
            "column {left}: {found}, not {expected}"
        );
        let unknown = f64::from(known.unknowable.pixels[pixel]);
        assert!(
            unknown >= 1.0 - found - 1e-6,
            "what has no place cannot be known"
        );
    });
}
