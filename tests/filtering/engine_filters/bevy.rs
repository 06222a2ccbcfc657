//! The blur of the Bevy engine.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, light, moving_edge, white};

#[test]
fn each_sample_is_two_taps_and_none_is_the_pixel_itself() {
    for samples in [1, 3] {
        let picture = moving_edge(160, 64, [64.0, 0.0]);
        let output = picture.blur("bevy", "default", &format!("samples={samples}"));
        let values = output.pixels.iter().map(|pixel| pixel[0]);
        let on_ramp: Vec<f32> = values
            .filter(|value| *value > 0.0 && *value < 1.0)
            .collect();
        assert!(on_ramp.len() > 2000, "the ramp is 64 pixels in 64 rows");
        // Values on the ramp differ by whole taps of equal weight. Bilinear fetches mix both sides
        // in one pixel of 64 / (2 samples) at the edge.
        let share_of = |taps: f32| {
            let whole = |value: &&f32| (*value * taps - (*value * taps).round()).abs() < 1e-4;
            on_ramp.iter().filter(whole).count() as f64 / on_ramp.len() as f64
        };
        let taps = 2 * samples;
        assert_within(share_of(taps as f32), 0.8..);
        assert_within(share_of((taps + 1) as f32), ..0.1);
    }
}

#[test]
fn nothing_blurs_outside_a_movers_silhouette() {
    let output = Picture::halves(120, 40, BLACK_WALL, white(24.0)).blur("bevy", "high", "");
    assert_eq!(light(&output, 0..60), 0.0);
    // The inside is blurred, so the edge keeps half its height.
    assert_within(column(&output, 61), ..0.6);
}

#[test]
fn a_surface_in_front_counts_by_its_motion_over_a_whole_frame() {
    // A black background moves right, with a white surface in front of its right half. The
    // background's taps reach 5 pixels to each side.
    let seen = |speed: f32| {
        let mut picture = Picture::halves(120, 64, BLACK_WALL.moving(40.0, 0.0), white(speed));
        picture.exposure = 0.25;
        column(&picture.blur("bevy", "high", ""), 57)
    };
    // An object that moves 20 pixels in a frame moves 2.5 to each side while the shutter is open.
    // Yet at 2.5 pixels from it, all of the trail that it covers counts: a quarter.
    assert_near(seen(20.0), 0.25, 0.05);
    // A slower object moves 2 pixels in half a whole frame. It does not count, except in the half
    // pixel at its edge, where a bilinear fetch mixes its motion with the background's.
    assert_within(seen(4.0), ..0.08);
}

#[test]
fn motion_below_a_pixel_stays_sharp_at_every_exposure() {
    for (speed, blurs) in [(0.99, false), (1.01, true)] {
        let mut picture = moving_edge(40, 16, [speed, 0.0]);
        picture.exposure = 4.0;
        let output = picture.blur("bevy", "high", "");
        assert_eq!(output != picture.color, blurs, "{speed} pixels per frame");
    }
}

#[test]
fn a_wide_picture_skews_weights_on_diagonals() {
    // The background moves down and right; the object in front moves right, and 7.5 pixels of its
    // motion follow the diagonal.
    let light = |width: u32, metric: &str| -> f64 {
        let picture = Picture::new(width, 120, |x, _| match x {
            0..60 => BLACK_WALL.moving(20.0, 20.0),
            _ => white(30.0),
        });
        let output = picture.blur("bevy", "high", &format!("metric={metric}"));
        light(&output, 0..60)
    };
    // Measured in pixels, three tenths: 7.5 of the ten pixels that taps reach count, as a ramp.
    assert_within(light(120, "pixel"), 1.0..);
    // The two agree up to rounding only if width and height are equal.
    assert_near(light(120, "uv"), light(120, "pixel"), 0.01);
    // In a picture four times as wide, the vertical part of the motion counts 16 times as much, and
    // almost nothing arrives.
    assert!(light(480, "uv") < 0.5 * light(480, "pixel"));
}

#[test]
fn the_sky_counts_at_any_motion() {
    let seen = |depth: f32| {
        let [ground, sky] =
            [BLACK_WALL.moving(24.0, 0.0), white(0.0)].map(|surface| surface.at(depth));
        let picture = Picture::halves(120, 64, ground, sky);
        column(&picture.blur("bevy", "high", ""), 56)
    };
    // 8.5 of the trail's 24 pixels are beyond the edge; one tap of 16 more or less.
    assert_near(seen(frame::FAR_DEPTH), 8.5 / 24.0, 1.0 / 16.0);
    // A still wall at the same depth has no motion; bilinear fetches mix motions in the half pixel
    // at the edge.
    assert_within(seen(20.0), ..0.05);
}

#[test]
fn taps_off_the_picture_are_skipped() {
    // A white column at the border, which moves with everything else.
    let picture = Picture::new(80, 64, |x, _| white(24.0).gray((x == 0).into()));
    // 12 pixels of the trail are to the left of 4.5, and 16.5 pixels of it are on the picture, one
    // of them the white column. Clamped taps would make it 8.5 of 24.
    let output = picture.blur("bevy", "high", "");
    assert_near(column(&output, 4), 1.0 / 16.5, 0.03);
}
