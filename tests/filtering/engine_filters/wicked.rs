//! The preset of Wicked Engine.

use tests::near::assert_near;
use tests::picture::{column, light_above, moving_edge, ramp_length, slow_above_fast};

#[test]
fn the_smear_of_wicked_depends_on_the_width_of_the_picture() {
    for width in [240, 480] {
        println!("{width} wide");
        let picture = moving_edge(width, 64, [12.0, 0.0]);
        let length = ramp_length(&picture.blur("jimenez", "wicked", "strength=-100"));
        // 1500 pixels per picture width of motion, scaled by noise with a mean square of a third;
        // 16 taps at (2 i - 15) / 15.
        let taps = (0..16).map(|i| ((2.0 * f64::from(i) - 15.0) / 15.0).powi(2));
        let square = taps.sum::<f64>() / 16.0 / 3.0;
        let expected = (3.0 * square).sqrt() * 1500.0 * 12.0 / f64::from(width);
        // A twentieth: noise of 64 rows.
        assert_near(length / expected, 1.0, 0.05);
    }
}

#[test]
fn the_kernel_of_wicked_is_peaked_and_not_a_box() {
    // 750 pixels per picture width to each side, of 24 / 480: 37.5 pixels.
    let picture = moving_edge(480, 128, [24.0, 0.0]);
    let output = picture.blur("jimenez", "wicked", "strength=-100");
    let share = |part: f64| {
        let reach = (37.5 * part).round() as u32;
        column(&output, 240 + reach - 1) - column(&output, 240 - reach)
    };
    // Uniform taps times uniform noise have the density -ln|x| / 2, so x (1 - ln x) is within x of
    // the middle.
    for part in [0.2f64, 0.4] {
        // 16 taps of 128 rows, in whole pixels of 37.5.
        assert_near(share(part), part * (1.0 - part.ln()), 0.05);
    }
}

#[test]
fn wicked_counts_motion_fully_above_a_tenth_of_the_fastest_and_not_below() {
    let light = |part: f32| {
        let picture = slow_above_fast(24.0 * part, 24.0);
        light_above(&picture.blur("jimenez", "wicked", "strength=-100"), 1..40)
    };
    // In its unit the fastest motion is 7.5, and motions from 6.5 / 75 to 7.5 / 75 of it count in
    // part.
    assert_eq!(light(0.08), 0.0);
    assert!(light(0.095) > 0.0 && light(0.095) < 0.9 * light(0.11));
    // Below that, the fast half hides itself; equal up to rounding.
    assert_near(light(0.11) / light(0.8), 1.0, 1e-3);
}
