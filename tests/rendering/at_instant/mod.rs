//! State at the frame's instant of everything that a shutter sees.
//!
//! The camera sees one metre as one pixel at the panels' distance, with the origin at the image's
//! centre.

mod frozen;

use std::f64::consts::{FRAC_PI_2, PI};

use frame::{Alignment, Truth};
use glam::DVec3;
use scene::{Key, Scene, Turn};

use crate::renders::*;

const WIDTH: u32 = 32;
const HEIGHT: u32 = 12;
/// Distance of the panels: half the height in pixels is the focal length at a vertical field of
/// view of 90 degrees.
const DISTANCE: f64 = 0.5 * HEIGHT as f64;
/// Speed in pixels per frame.
const SPEED: f64 = 12.0;
/// Exposure in frames.
const EXPOSURE: f64 = 0.75;
/// Tolerance for 1024 stratified samples of a step: they err by less than 0.003 in nearly every
/// pixel (coverage: 0.0022 rms in the worst).
const STEP_ERROR: f64 = 0.012;

fn render(scene: &Scene, alignment: Alignment, samples_per_pixel: u32) -> Truth {
    let mut settings = settings_of_two([WIDTH, HEIGHT], samples_per_pixel);
    settings.exposure = Some(EXPOSURE);
    render_truth(scene, &settings, alignment)
}

/// Makes an unlit wall, `gap` metres behind an unlit panel with its middle passing `at` at `t = 0`.
/// Both are higher than any blur.
fn panel_over_wall(gap: f64, at: f64, width: f32) -> Scene {
    let mut scene = empty_scene("panel");
    let wall = placed(DVec3::new(0.0, 0.0, -DISTANCE - gap));
    add(&mut scene, rectangle(200.0, 200.0), glowing(0.2), wall);
    let motion = drift(DVec3::new(at, 0.0, -DISTANCE), DVec3::X * SPEED);
    add(&mut scene, rectangle(width, 100.0), glowing(0.8), motion);
    scene
}

/// Calls `check` with each column's left border, in pixels from the picture's centre, and the index
/// of its pixel in the middle row.
fn for_each_column(mut check: impl FnMut(f64, usize)) {
    for column in 0..WIDTH {
        let left = f64::from(column) - 0.5 * f64::from(WIDTH);
        check(left, ((HEIGHT / 2) * WIDTH + column) as usize);
    }
}

/// Integrates `value` over a column of unit width and the shutter, by midpoints.
fn mean_over(left: f64, alignment: Alignment, value: impl Fn(f64, f64) -> f64) -> f64 {
    const STEPS: u32 = 400;
    let shutter = alignment.shutter(EXPOSURE).unwrap();
    let middle = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
    let places =
        (0..STEPS).flat_map(|x| (0..STEPS).map(move |t| (left + middle(x), shutter.at(middle(t)))));
    places.map(|(x, t)| value(x, t)).sum::<f64>() / f64::from(STEPS * STEPS)
}

#[test]
fn uncovered_background_and_pixels_beyond_the_border_are_unknowable() {
    // The panel is in the middle or reaches over the right border, far from the wall or very near
    // it.
    let cases = [(2.0, 0.0, 5.0), (2.0, 13.0, 8.0), (1e-5, 0.0, 5.0)];
    for ((gap, at, half), alignment) in cases.into_iter().zip(Alignment::ALL) {
        let scene = panel_over_wall(gap, at, 2.0 * half as f32);
        let known = render(&scene, alignment, 4096).at_instant_mean();
        // Unlit surfaces need no light of the instant.
        assert!(known.shift.pixels.iter().all(|shift| *shift == [0.0; 3]));
        for_each_column(|left, pixel| {
            let expected = mean_over(left, alignment, |x, t| {
                let covered = |x: f64, t: f64| (x - at - SPEED * t).abs() < half;
                let unknown = if covered(x, t) {
                    // The position of the panel's point at the instant.
                    (x - SPEED * t).abs() > 0.5 * f64::from(WIDTH)
                } else {
                    covered(x, 0.0)
                };
                f64::from(unknown)
            });
            let actual = f64::from(known.unknowable.pixels[pixel]);
            let what = format!("{alignment}, panel at {at}, column {left}");
            expect_near(&what, actual, expected, STEP_ERROR);
        });
    }
}

#[test]
fn a_sliding_panel_s_samples_come_from_its_whole_way() {
    for alignment in Alignment::ALL {
        // Wider than the picture and its motion together.
        let truth = render(&panel_over_wall(2.0, 0.0, 90.0), alignment, 1024);
        let mean = truth.at_instant_mean();
        for_each_column(|left, pixel| {
            let shutter = alignment.shutter(EXPOSURE).unwrap();
            let [open, close] = [shutter.open, shutter.close].map(|t| -SPEED * t);
            let offset = 0.5 * (open + close);
            // The mean square of a uniform number between two others, and of the position in the
            // pixel.
            let spread = (open * open + open * close + close * close) / 3.0 + 1.0 / 12.0;
            assert_eq!(mean.placed.pixels[pixel], 1.0);
            let [x, y] = mean.offset.pixels[pixel].map(f64::from);
            let [xx, yy] = mean.spread.pixels[pixel].map(f64::from);
            // Stratified samples of smooth functions: 1/1024 of the range is several times their
            // error.
            let error = SPEED * EXPOSURE / 1024.0;
            let what = format!("{alignment}, column {left}");
            expect_near(&what, x, offset, error);
            expect_near(&what, y, 0.0, error);
            expect_near(&what, xx, spread, 2.0 * SPEED * EXPOSURE * error);
            expect_near(&what, yy, 1.0 / 12.0, error);
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
    let sheet = through([0.0, 1.0].map(|time| Key {
        time,
        translation: DVec3::new(0.0, 0.0, -DISTANCE),
        turn,
        ..Key::REST
    }));
    add(&mut scene, rectangle(8.0, 8.0), glowing(1.0), sheet);
    let known = render(&scene, Alignment::Trailing, 1024).at_instant_mean();
    // The ray through `x` meets the sheet, turned by `angle`, at this distance from its axis.
    let met = |x: f64, angle: f64| DISTANCE * x / (DISTANCE * angle.cos() + x * angle.sin());
    let front = |x: f64, t: f64| {
        let angle = PI / EXPOSURE * t;
        f64::from(angle.abs() < FRAC_PI_2 && met(x, angle).abs() < 4.0)
    };
    // The axis is between two pixels. Their mean does not depend on which of them sees the sheet's
    // nearer half.
    let shown = [0.0, -1.0].map(|left| mean_over(left, Alignment::Trailing, front));
    let expected = 1.0 - 0.5 * (shown[0] + shown[1]);
    let centre = (HEIGHT / 2 * WIDTH + WIDTH / 2) as usize;
    let unknown = [centre, centre - 1].map(|pixel| f64::from(known.unknowable.pixels[pixel]));
    let actual = 0.5 * (unknown[0] + unknown[1]);
    expect_near("the sheet's other side", actual, expected, STEP_ERROR);
}

#[test]
fn points_behind_the_camera_have_no_place() {
    let mut scene = empty_scene("pan");
    let rate = 2.0;
    scene.camera.motion = spin(DVec3::ZERO, DVec3::Y, rate);
    let known = render(&scene, Alignment::Trailing, 1024).at_instant_mean();
    for_each_column(|left, pixel| {
        // The view turns left: earlier views are to the right, and behind the camera beyond a right
        // angle.
        let expected = mean_over(left, Alignment::Trailing, |x, t| {
            f64::from((x / DISTANCE).atan() - rate * t < FRAC_PI_2)
        });
        let placed = f64::from(known.placed.pixels[pixel]);
        expect_near(&format!("column {left}"), placed, expected, STEP_ERROR);
        let unknown = f64::from(known.unknowable.pixels[pixel]);
        // A point without a position cannot be known.
        assert!(unknown >= 1.0 - placed - 1e-6, "{unknown} {placed}");
    });
}
