//! The blur of three.js.

use tests::near::assert_near;
use tests::picture::{Picture, moving_edge, ramp_length, white};

#[test]
fn a_blur_amount_of_a_half_is_the_exposure() {
    let picture = moving_edge(160, 16, [24.0, 0.0]);
    let length = |preset: &str, amount: &str| {
        ramp_length(&picture.blur("three", preset, &format!("blur_amount={amount}")))
    };
    // Sixteen taps a fifteenth apart are a fifteenth longer than the trail, and the pixel's own
    // colour weighs on the middle: 1.04.
    assert_near(length("default", "0.5"), 24.0, 1.2);
    assert_near(length("default", "1"), 48.0, 2.4);
    assert_near(length("corrected", "1"), 24.0, 1.2);
}

/// Blurs a bright dot that moves up to the right; returns the light at an offset from it, in pixels
/// to the right and down.
fn blurred_dot(preset: &str) -> impl Fn(i32, i32) -> f32 {
    let picture = Picture::new(65, 65, |x, y| {
        let dot = (x, y) == (32, 32);
        white(0.0).moving(15.0, -15.0).gray(dot.into())
    });
    let output = picture.blur("three", preset, "");
    move |x, y| output.at((32 + x) as u32, (32 + y) as u32)[0]
}

#[test]
fn what_moves_up_to_the_right_is_smeared_along_the_other_diagonal() {
    let light = |preset: &str, turn: i32| -> f32 {
        let at = blurred_dot(preset);
        (1..=6).map(|i| at(i, turn * i) + at(-i, -turn * i)).sum()
    };
    // +y is down: a trail up to the right goes from (-i, i) to (i, -i).
    assert!(light("corrected", -1) > 0.3 && light("corrected", 1) == 0.0);
    assert!(light("default", 1) > 0.1 && light("default", -1) == 0.0);
}

#[test]
fn taps_lie_a_fifteenth_too_far_ahead() {
    let at = blurred_dot("corrected");
    // Motion of 15 pixels: taps one pixel apart, from 6.5 behind to 8.5 ahead. A tap ahead brings
    // the dot to a pixel behind.
    assert!(at(-8, 8) > 0.0 && at(-9, 9) > 0.0 && at(-10, 10) == 0.0);
    assert!(at(6, -6) > 0.0 && at(7, -7) > 0.0 && at(8, -8) == 0.0);
}
