//! The presets of Unity HDRP.

use tests::near::{assert_near, assert_within};
use tests::picture::{
    BLACK_WALL, Picture, Surface, column, light, moving_edge, ramp_length, white,
};

const BACKGROUND: Surface = BLACK_WALL.moving(24.0, 0.0);

#[test]
fn an_intensity_of_one_is_a_shutter_of_180_degrees() {
    let picture = moving_edge(160, 64, [24.0, 0.0]);
    for (intensity, expected) in [("1", 12.0), ("2", 24.0)] {
        let output = picture.blur("jimenez", "hdrp", &format!("strength={intensity}"));
        // A quarter of the motion to each side. Nearest fetches round by half a pixel.
        assert_near(ramp_length(&output), expected, 0.5);
    }
}

#[test]
fn the_noise_of_hdrp_shifts_all_taps_of_a_pixel_to_one_side() {
    // Brightness is the column, so a mean of taps is their mean position.
    let picture = Picture::new(200, 64, |x, _| white(24.0).gray(x as f32));
    let output = picture.blur("jimenez", "hdrp", "");
    let pixels = (50..150).flat_map(|x| (0..48).map(move |y| (x, y)));
    let shifts: Vec<f32> = pixels.map(|(x, y)| output.at(x, y)[0] - x as f32).collect();
    let mean = shifts.iter().map(|shift| shift.abs()).sum::<f32>() / shifts.len() as f32;
    // Taps shift by up to half a step of 3 pixels. With nearest fetches, a third of the noise
    // shifts them by 1.5 pixels and the rest by 0.5. Mirrored taps would not shift.
    assert_near(mean, 5.0 / 6.0, 0.05);
}

#[test]
fn hdrp_reads_the_nearest_pixels_and_fewer_on_short_trails() {
    // The second trail has a little over 5 pixels. Its length counts in parts of the picture's
    // diagonal, which makes it a tenth longer.
    for (speed, taps) in [(25.0, 8.0), (2.4, 6.0)] {
        let stripes = Picture::new(160, 64, |x, _| white(speed).gray((x % 2) as f32));
        for pixel in &stripes.blur("jimenez", "hdrp", "").pixels {
            // All taps have equal weight: each pixel is a mean of zeros and ones.
            let ones = taps * pixel[0];
            assert_near(ones, ones.round(), 1e-5);
        }
    }
}

#[test]
fn a_tap_that_moves_half_as_far_as_the_trail_counts_whole() {
    // A white surface in front moves half as fast as the background.
    let picture = Picture::halves(160, 64, BACKGROUND, white(12.0));
    let [weighted, ignored] = ["weighted", "ignored"].map(|direction| {
        let overrides = format!("direction={direction} plain_tiles=never");
        picture.blur("jimenez", "hdrp", &overrides)
    });
    let pairs = weighted.pixels.iter().zip(&ignored.pixels);
    let apart = pairs.map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
    assert_within(apart, ..1e-5);
}

#[test]
fn directions_count_only_where_the_pixel_itself_moves() {
    // At the bottom, a fast surface in front sets the trail; at the top, a white one moves down
    // past a wall.
    let seen = |wall: f32| {
        let picture = Picture::new(160, 64, |x, y| match (x, y) {
            (_, 40..) => white(25.0).gray(0.0),
            (80.., _) => white(0.0).moving(0.0, 9.0),
            _ => BLACK_WALL.moving(wall, 0.0),
        });
        let output = picture.blur("jimenez", "hdrp", "plain_tiles=never");
        (32..38).map(|y| output.at(76, y)[0]).fold(0.0, f32::max)
    };
    // 4 of the 12 pixels that trails reach.
    assert_within(seen(0.0), 0.1..);
    assert_eq!(seen(4.0), 0.0);
}

#[test]
fn a_pixel_that_moves_like_the_fastest_shows_only_its_taps() {
    // A moving wall behind a still object: half of its taps have no weight next to the object.
    let picture = Picture::new(160, 64, |x, _| match x {
        0..80 => white(0.0),
        80 => BACKGROUND.gray(1.0),
        _ => BACKGROUND,
    });
    let seen = |rest: &str| {
        let output = picture.blur("jimenez", "hdrp", &format!("rest={rest}"));
        column(&output, 80)
    };
    // The white object keeps half of itself next to the wall's black.
    assert_within(seen("own"), 0.5..);
    // One of about four taps may read the pixel itself.
    assert_within(seen("layers"), ..0.3);
}

/// Makes a speckled background that moves right, with a still black object in front on the left.
fn still_in_front() -> Picture {
    let picture = Picture::halves(160, 64, white(0.0).gray(0.0), BACKGROUND);
    picture.speckled(5, |x, _| x >= 80)
}

#[test]
fn hdrp_leaves_moving_background_sharp_beside_a_still_foreground() {
    let picture = still_in_front();
    let change = |mirror: &str| {
        let output = picture.blur("jimenez", "hdrp_mirrored", &format!("mirror={mirror}"));
        let changes = (0..64).map(|y| output.at(80, y)[0] - picture.color.at(80, y)[0]);
        changes.map(|change| f64::from(change.abs())).sum::<f64>() / 64.0
    };
    // Speckles differ by a third on average. A mean of several differs from each of them by about a
    // quarter, and half of the taps read the pixel's own colour again.
    let usual = change("slow_background");
    assert_within(usual, 0.08..);
    // Nearly all pairs reach the still object. Its motion is zero, and both taps of a pair get its
    // weight.
    assert_within(change("fast_background"), ..0.1 * usual);
}

#[test]
fn steps_that_end_late_keep_still_things_out_of_the_trail_at_its_start() {
    // A background pixel next to a still object in front; a step is 3 pixels.
    let picture = Picture::halves(160, 64, white(0.0), BACKGROUND);
    let seen = |spread: &str| {
        let overrides = format!("mirror=off spread={spread} direction=ignored");
        column(&picture.blur("jimenez", "hdrp", &overrides), 80)
    };
    // One of eight taps is less than a step to the left, and counts for the remaining part of the
    // step.
    assert_within(seen("steps"), 0.03..);
    assert_eq!(seen("late_steps"), 0.0);
}

#[test]
fn late_steps_equal_normal_steps_after_the_first() {
    let picture = still_in_front();
    let output = |placement: &str, spread: &str| {
        let overrides = format!("placement={placement} spread={spread} noise=none");
        picture.blur("jimenez", "hdrp", &overrides)
    };
    // Taps at the ends of steps are one step away or more.
    assert!(output("with_centre", "late_steps") == output("with_centre", "steps"));
    assert!(output("middles", "late_steps") != output("middles", "steps"));
}

#[test]
fn weighted_directions_exclude_motion_across_the_trail() {
    // A white surface on the right moves down; everything around it moves right.
    let [left, right] = [BLACK_WALL.moving(25.0, 0.0), white(0.0).moving(0.0, 9.0)];
    let picture = Picture::halves(160, 64, left, right);
    let seen = |direction: &str| {
        let overrides = format!("direction={direction} plain_tiles=never mirror=off");
        column(&picture.blur("jimenez", "hdrp", &overrides), 76)
    };
    // A third of the right half of the taps is beyond 4 of 12 pixels.
    assert_within(seen("ignored"), 0.2..);
    assert_eq!(seen("weighted"), 0.0);
}

#[test]
fn a_still_foreground_stays_sharp() {
    let picture = still_in_front();
    for preset in ["slides_2014", "hdrp", "hdrp_mirrored"] {
        let output = picture.blur("jimenez", preset, "");
        // Up to one step, 12 / pairs pixels, where a still pixel's spread ends.
        assert_eq!(light(&output, 0..76), 0.0, "{preset}");
    }
    // Late steps end at once.
    let output = picture.blur("jimenez", "hdrp", "");
    assert_within(light(&output, 0..80), ..0.01);
}
