//! Both modes of Babylon.js's blur.

use frame::{FAR_DEPTH, Frame, Image, Size};
use tests::near::{assert_near, assert_within};
use tests::picture::{Picture, moving_edge, ramp_length, white};

use crate::camera_gather::{blur_frame, render_frame};
use crate::reference::{read_clamped, sample_linear};

#[test]
fn the_longest_trail_has_as_many_pixels_as_there_are_samples() {
    for (speed, samples, expected) in [(90.0, "32", 32.0), (90.0, "64", 64.0), (24.0, "32", 24.0)] {
        let picture = moving_edge(256, 16, [speed, 0.0]);
        let length =
            ramp_length(&picture.blur("babylon", "default", &format!("samples={samples}")));
        // The step between pixels, 8 bits of velocity, and the first tap, which the pixel itself
        // replaces.
        assert_near(length, expected, 3.0);
    }
}

#[test]
fn a_wide_picture_turns_diagonals_upright() {
    let picture = Picture::new(160, 80, |x, y| {
        let dot = (x, y) == (80, 40);
        white(0.0).moving(20.0, -20.0).gray(dot.into())
    });
    let output = picture.blur("babylon", "default", "fetch=filtered");
    let lit = (0..160).flat_map(|x| (0..80).map(move |y| (x, y)));
    let lit = lit.filter(|(x, y)| output.at(*x, *y)[0] > 1e-3);
    let [mut across, mut up] = [0.0f64; 2];
    for (x, y) in lit {
        across = across.max((f64::from(x) - 80.0).abs());
        up = up.max((f64::from(y) - 40.0).abs());
    }
    // The motion is twice as steep in parts of width and height as in pixels.
    assert_near(up / across, 2.0, 0.25);
}

#[test]
fn the_screen_based_mode_leaves_the_sky_sharp() {
    let frame = render_frame(0);
    let output = by_camera(&frame);
    let sky = (0..frame.depth.pixels.len()).filter(|i| frame.depth.pixels[*i] == FAR_DEPTH);
    let sky: Vec<usize> = sky.collect();
    assert!(sky.len() > 100, "the flight shows a sky");
    let is_sharp = |i: &usize| output.pixels[*i] == frame.color.pixels[*i];
    assert!(sky.iter().all(is_sharp));
}

fn by_camera(frame: &Frame) -> Image {
    // Between pixels, so that rounding decides nothing.
    blur_frame(frame, "babylon_screen", None, "fetch=filtered")
}

#[test]
fn the_screen_based_mode_equals_its_source_in_64_bits() {
    let frame = render_frame(0);
    let output = by_camera(&frame);
    let Size { width, height } = frame.size();
    let mut blurred = 0;
    for (x, y) in (0..width).flat_map(|x| (0..height).map(move |y| (x, y))) {
        if *frame.depth.at(x, y) == FAR_DEPTH {
            continue;
        }
        // The screen based branch of motionBlur.fragment.fx at 39a32df, line by line, in pixels.
        // Its velocity points to the previous position; this frame's is only the camera's.
        let velocity = frame.velocity.at(x, y);
        let velocity = velocity.map(|part| -f64::from(part) * frame.exposure);
        let speed = velocity[0].hypot(velocity[1]);
        // At whole numbers the last bit decides how many taps there are.
        if (speed - speed.round()).abs() < 1e-3 {
            continue;
        }
        let samples = speed.clamp(1.0, 32.0) as i32;
        let (u, v) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
        let linear =
            |x, y| sample_linear([x, y], |x, y| read_clamped(&frame.color, x, y)[0].into());
        let mut result = linear(u, v);
        for i in 1..samples {
            let part = f64::from(i) / f64::from(samples - 1) - 0.5;
            result += linear(u + velocity[0] * part, v + velocity[1] * part);
        }
        result /= f64::from(samples);
        let actual = f64::from(output.at(x, y)[0]);
        // Positions in 32 bits err by 1e-5 pixels, and neighbouring pixels differ by up to 2.
        assert_near(actual, result, 1e-3);
        blurred += i32::from((actual - f64::from(frame.color.at(x, y)[0])).abs() > 0.01);
    }
    assert_within(blurred, 41.0..);
}
