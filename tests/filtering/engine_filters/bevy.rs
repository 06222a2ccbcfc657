//! The blur of the Bevy engine.

use tests::picture::{BLACK_WALL, Picture, Surface, column, moving_edge, white};

#[test]
fn each_sample_is_two_taps_and_none_is_the_pixel_itself() {
    for samples in [1, 3] {
        let picture = moving_edge(160, 64, [64.0, 0.0]);
        let output = picture.blur("bevy", "default", &[("samples", &samples.to_string())]);
        let on_ramp: Vec<f32> = output
            .pixels
            .iter()
            .map(|pixel| pixel[0])
            .filter(|value| *value > 0.0 && *value < 1.0)
            .collect();
        assert!(on_ramp.len() > 2000, "the ramp is 64 pixels in 64 rows");
        // One tap of equal weight more or less. Bilinear fetches mix both sides in one pixel of 64 / (2 samples) at the
        // edge.
        let share_of = |taps: f32| {
            let whole = |value: &&f32| (*value * taps - (*value * taps).round()).abs() < 1e-4;
            on_ramp.iter().filter(whole).count() as f64 / on_ramp.len() as f64
        };
        let taps = 2 * samples;
        assert!(share_of(taps as f32) > 0.8, "{}", share_of(taps as f32));
        assert!(
            share_of((taps + 1) as f32) < 0.1,
            "{}",
            share_of((taps + 1) as f32)
        );
    }
}

#[test]
fn nothing_blurs_outside_a_movers_silhouette() {
    let picture = Picture::new(
        120,
        40,
        |x, _| {
            if x < 60 { BLACK_WALL } else { white(24.0) }
        },
    );
    let output = picture.blur("bevy", "high", &[]);
    for x in 0..60 {
        assert_eq!(column(&output, x), 0.0, "column {x}");
    }
    // The inside is blurred, so the edge keeps half its height.
    assert!(column(&output, 61) < 0.6, "{}", column(&output, 61));
}

/// Makes a black background that moves right, with something white in front of its right half.
fn in_front_of_motion(speed: f32) -> Picture {
    Picture::new(120, 64, |x, _| match x {
        0..60 => Surface {
            velocity: [40.0, 0.0],
            ..BLACK_WALL
        },
        _ => white(speed),
    })
}

#[test]
fn a_surface_in_front_counts_by_its_motion_over_a_whole_frame() {
    let shutter = |speed: f32| {
        let mut picture = in_front_of_motion(speed);
        // The background's taps reach 5 pixels to each side.
        picture.exposure = 0.25;
        picture.blur("bevy", "high", &[])
    };
    // Something that moves 20 pixels in a frame moves 2.5 to each side while the shutter is open. Yet at 2.5 pixels
    // from it, all of the trail that it covers counts: a quarter.
    assert!((column(&shutter(20.0), 57) - 0.25).abs() < 0.05);
    // This one moves 2 pixels in half a whole frame, so it does not count, except in the half pixel at its edge where a
    // bilinear fetch mixes its motion with the background's.
    assert!(column(&shutter(4.0), 57) < 0.08);
}

#[test]
fn motion_below_a_pixel_stays_sharp_at_every_exposure() {
    for (speed, blurs) in [(0.99, false), (1.01, true)] {
        let mut picture = moving_edge(40, 16, [speed, 0.0]);
        picture.exposure = 4.0;
        let output = picture.blur("bevy", "high", &[]);
        assert_eq!(output != picture.color, blurs, "{speed} pixels per frame");
    }
}

#[test]
fn a_wide_picture_skews_weights_on_diagonals() {
    // The background moves down and right; the object in front moves right, and 7.5 pixels of its motion follow the
    // diagonal.
    let crossing = |width: u32, height: u32| {
        Picture::new(width, height, |x, _| match x {
            0..60 => Surface {
                velocity: [20.0, 20.0],
                ..BLACK_WALL
            },
            _ => white(30.0),
        })
    };
    let light = |picture: &Picture, metric: &str| -> f64 {
        let output = picture.blur("bevy", "high", &[("metric", metric)]);
        (0..60).map(|x| column(&output, x)).sum()
    };
    let square = crossing(120, 120);
    let wide = crossing(480, 120);
    // Measured in pixels, three tenths: 7.5 of the ten pixels that taps reach count, as a ramp.
    assert!(light(&square, "pixel") > 1.0);
    // The two agree up to rounding only if width and height are equal.
    assert!((light(&square, "uv") - light(&square, "pixel")).abs() < 0.01);
    // In a picture four times as wide, the vertical part of the motion counts 16 times as much, and next to nothing
    // arrives.
    assert!(light(&wide, "uv") < 0.5 * light(&wide, "pixel"));
}

#[test]
fn the_sky_counts_at_any_motion() {
    let seen = |depth: f32| {
        let picture = Picture::new(120, 64, |x, _| Surface {
            gray: if x < 60 { 0.0 } else { 1.0 },
            velocity: [if x < 60 { 24.0 } else { 0.0 }, 0.0],
            depth,
        });
        column(&picture.blur("bevy", "high", &[]), 56)
    };
    // 8.5 of the trail's 24 pixels lie beyond the edge; one tap of 16 more or less.
    let expected = 8.5 / 24.0;
    let found = seen(frame::FAR_DEPTH);
    assert!(
        (found - expected).abs() < 1.0 / 16.0,
        "{found} instead of {expected}"
    );
    // A still wall at the same depth has no motion; bilinear fetches mix motions in the half pixel at the edge.
    assert!(seen(20.0) < 0.05, "{}", seen(20.0));
}

#[test]
fn taps_off_the_picture_are_skipped() {
    // A white column at the border, which moves with everything else.
    let picture = Picture::new(80, 64, |x, _| Surface {
        gray: if x == 0 { 1.0 } else { 0.0 },
        velocity: [24.0, 0.0],
        depth: 2.0,
    });
    // 12 pixels of the trail lie to the left of 4.5, and 16.5 pixels of it are on the picture, of which the white
    // column is one. Clamped taps would make it 8.5 of 24.
    let found = column(&picture.blur("bevy", "high", &[]), 4);
    assert!((found - 1.0 / 16.5).abs() < 0.03, "{found}");
}
