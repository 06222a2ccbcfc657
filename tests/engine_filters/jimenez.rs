//! The mirrored, depth-weighted family of Jimenez 2014.

use frame::Image;
use tests::random::Random;

use crate::picture::{BLACK_WALL, Picture, Surface, column, moving_edge, ramp_length, white};

const HONEST_LENGTHS: [&str; 3] = ["advanced_warfare", "hdrp", "kajiya"];

/// Sum of the columns.
fn light(image: &Image, columns: std::ops::Range<u32>) -> f64 {
    columns.map(|x| column(image, x)).sum()
}

#[test]
fn a_mover_smears_half_its_motion_over_what_lies_behind() {
    let picture = Picture::new(
        160,
        64,
        |x, _| {
            if x < 80 { BLACK_WALL } else { white(24.0) }
        },
    );
    for preset in HONEST_LENGTHS {
        let output = picture.blurred("jimenez", preset, &[]);
        // A ramp from a half to nothing over 12 pixels holds 3 pixels of light. Taps to the step: +-12/8 in the width.
        let found = light(&output, 0..80);
        assert!((found - 3.0).abs() < 0.4, "{preset}: {found}");
        // Kajiya displaces pixels by up to a step, 3 pixels, and has half a step more on each side.
        assert!(light(&output, 0..60) < 0.01, "{preset}");
    }
}

#[test]
fn o3de_smears_ten_times_as_far_as_the_exposure_says() {
    let picture = moving_edge(400, 64, [24.0, 0.0]);
    let found = ramp_length(&picture.blurred("jimenez", "o3de", &[]));
    // 24 pairs, a quarter of a step to and fro, at whole pixels of the 120 to each side.
    let offsets: Vec<f64> = (0..24)
        .flat_map(|i| [f64::from(i) - 0.25, f64::from(i) + 0.25])
        .map(|steps| (steps * 5.0).trunc())
        .collect();
    let square = offsets.iter().map(|at| at * at).sum::<f64>() / offsets.len() as f64;
    let expected = (12.0 * square).sqrt();
    // The edge lies between texels; offsets are whole.
    assert!(
        (found - expected).abs() < 0.5,
        "{found} instead of {expected}"
    );
    assert!(found / 24.0 > 9.0);
}

/// A still white post at 60..70 in front of a black wall; from row 40 on, something black moves in front of both.
fn post_above_motion() -> Picture {
    Picture::new(160, 64, |x, y| match (x, y) {
        (_, 40..) => Surface {
            gray: 0.0,
            ..white(24.0)
        },
        (60..70, _) => Surface {
            velocity: [0.0, 0.0],
            ..white(0.0)
        },
        _ => BLACK_WALL,
    })
}

#[test]
fn o3de_mixes_still_things_near_a_mover_with_what_lies_behind_them() {
    let picture = post_above_motion();
    // The rows above the mover, within its tiles' reach.
    let darkest = |overrides: &[(&str, &str)]| {
        let output = picture.blurred("jimenez", "o3de", overrides);
        let mut post = (22..38).flat_map(|y| (60..70).map(move |x| (x, y)));
        post.try_fold(1.0f32, |least, (x, y)| Some(least.min(output.at(x, y)[0])))
            .unwrap()
    };
    assert!(darkest(&[]) < 0.5, "{}", darkest(&[]));
    // With the pixel's own motion for the tile's, only taps within a step of a still pixel count: one pair of 24.
    assert!(darkest(&[("spread", "steps")]) > 0.9);
}

#[test]
fn the_smear_of_wicked_depends_on_the_width_of_the_picture() {
    let length = |width: u32| {
        let picture = moving_edge(width, 64, [12.0, 0.0]);
        ramp_length(&picture.blurred("jimenez", "wicked", &[]))
    };
    // 1500 pixels per picture width of motion, scaled by noise whose mean square is a third; 16 taps at (2 i - 15) / 15.
    let expected = |width: u32| {
        let taps: f64 = (0..16)
            .map(|i| ((2.0 * f64::from(i) - 15.0) / 15.0).powi(2))
            .sum();
        let square = taps / 16.0 / 3.0;
        (3.0 * square).sqrt() * 1500.0 * 12.0 / f64::from(width)
    };
    for width in [240, 480] {
        // A twentieth: noise of 64 rows.
        let (found, expected) = (length(width), expected(width));
        assert!(
            (found / expected - 1.0).abs() < 0.05,
            "{width} wide: {found} instead of {expected}"
        );
    }
}

#[test]
fn the_kernel_of_wicked_is_peaked_and_not_a_box() {
    // 750 pixels per picture width to each side, 24 / 480 of it: 37.5 pixels.
    let picture = moving_edge(480, 128, [24.0, 0.0]);
    let output = picture.blurred("jimenez", "wicked", &[]);
    let share = |part: f64| {
        let reach = (37.5 * part).round() as u32;
        column(&output, 240 + reach - 1) - column(&output, 240 - reach)
    };
    // Even taps times even noise are distributed as -ln|x| / 2: within x of the middle lies x (1 - ln x).
    for part in [0.2f64, 0.4] {
        let expected = part * (1.0 - part.ln());
        // 16 taps of 128 rows, in whole pixels of 37.5.
        assert!(
            (share(part) - expected).abs() < 0.05,
            "{part}: {} instead of {expected}",
            share(part)
        );
    }
}

/// A black picture whose lower half moves fast in front, and in its upper half something white that moves less.
fn slow_above_fast(slow: f32, fast: f32) -> Picture {
    Picture::new(320, 64, |x, y| match (x, y) {
        (_, 32..) => Surface {
            gray: 0.0,
            ..white(fast)
        },
        (160.., _) => white(slow),
        _ => BLACK_WALL,
    })
}

/// Light in the rows just above the fast half, so many pixels left of the slow thing.
fn light_above(output: &Image, distances: std::ops::Range<u32>) -> f32 {
    let pixels = distances.flat_map(|distance| (24..32).map(move |y| (159 - distance, y)));
    pixels.map(|(x, y)| output.at(x, y)[0]).sum()
}

#[test]
fn wicked_lets_slow_things_smear_as_far_as_fast_ones() {
    // To each side the fast half smears 750 * 24 / 320 = 56 pixels, the slow thing should 11.
    let picture = slow_above_fast(4.8, 24.0);
    let as_published = picture.blurred("jimenez", "wicked", &[]);
    assert!(light_above(&as_published, 20..40) > 1.0);
    // Against the taps' distances, it ends after its own length and a step, 8 pixels. Half a pixel for fetches.
    let by_steps = picture.blurred("jimenez", "wicked", &[("spread", "steps")]);
    assert!(light_above(&by_steps, 1..8) > 1.0);
    assert_eq!(light_above(&by_steps, 20..40), 0.0);
}

#[test]
fn kajiya_lets_things_smear_twice_as_far_as_they_move() {
    // To each side the slow thing should smear 6 pixels; steps are 24 / 16 pixels.
    let picture = slow_above_fast(12.0, 48.0);
    let smear = |spread: &str| {
        let overrides = [("pairs", "16"), ("spread", spread)];
        picture.blurred("jimenez", "kajiya", &overrides)
    };
    assert!(light_above(&smear("pixels"), 9..12) > 0.5);
    // A pixel more than its whole motion, and half a pixel for fetches.
    assert_eq!(light_above(&smear("pixels"), 14..30), 0.0);
    // One step more than its half motion, and as much for the pixel's own displacement.
    assert_eq!(light_above(&smear("steps"), 9..12), 0.0);
}

#[test]
fn kajiya_displaces_still_pixels_near_a_mover() {
    let mut random = Random::new(7);
    let speckles: Vec<f32> = (0..160 * 64).map(|_| random.real(0.0, 1.0)).collect();
    let picture = Picture::new(160, 64, |x, y| match y {
        40.. => white(48.0),
        _ => Surface {
            gray: speckles[(y * 160 + x) as usize],
            ..BLACK_WALL
        },
    });
    let changed = |preset: &str, overrides: &[(&str, &str)]| {
        let output = picture.blurred("jimenez", preset, overrides);
        let wall = (0..38).flat_map(|y| (0..160).map(move |x| (x, y)));
        wall.filter(|(x, y)| (output.at(*x, *y)[0] - picture.color.at(*x, *y)[0]).abs() > 0.05)
            .count()
    };
    // Of 6080 pixels, those in tiles that know the mover.
    assert!(changed("kajiya", &[]) > 3000, "{}", changed("kajiya", &[]));
    // Without noise, the pixel stays where it is; taps are 6 pixels apart, and a still pixel's spread is one.
    assert_eq!(changed("kajiya", &[("noise", "none")]), 0);
}

/// A speckled background that moves right, and on the left something still and black in front.
fn still_in_front() -> Picture {
    let mut random = Random::new(5);
    let speckles: Vec<f32> = (0..160 * 64).map(|_| random.real(0.0, 1.0)).collect();
    Picture::new(160, 64, |x, y| match x {
        0..80 => Surface {
            gray: 0.0,
            ..white(0.0)
        },
        _ => Surface {
            gray: speckles[(y * 160 + x) as usize],
            velocity: [24.0, 0.0],
            ..BLACK_WALL
        },
    })
}

#[test]
fn hdrp_leaves_moving_background_sharp_beside_something_still_in_front() {
    let picture = still_in_front();
    let change = |mirror: &str| {
        let output = picture.blurred("jimenez", "hdrp", &[("mirror", mirror)]);
        let changes = (0..64).map(|y| output.at(80, y)[0] - picture.color.at(80, y)[0]);
        changes.map(|change| f64::from(change.abs())).sum::<f64>() / 64.0
    };
    // Speckles are a third apart on average; a mean of some is about a quarter away from each of them, and half of the
    // taps are the pixel's own colour again.
    let usual = change("slow_background");
    assert!(usual > 0.08, "{usual}");
    // Nearly all pairs reach the still thing, whose motion is nothing, and both taps take its weight.
    let turned = change("fast_background");
    assert!(turned < 0.1 * usual, "{turned} and {usual}");
}

#[test]
fn what_stands_still_in_front_stays_sharp() {
    let picture = still_in_front();
    for preset in ["advanced_warfare", "hdrp"] {
        let output = picture.blurred("jimenez", preset, &[]);
        // Up to the one step, 12 / pairs pixels, in which a still pixel's spread ends.
        assert_eq!(light(&output, 0..76), 0.0, "{preset}");
    }
    let output = picture.blurred("jimenez", "hdrp", &[]);
    assert!(light(&output, 0..80) < 0.01, "late steps end at once");
}

#[test]
fn steps_that_end_late_keep_still_things_out_of_the_trail_at_its_start() {
    // A pixel of the background beside something still in front; a step is 3 pixels.
    let picture = Picture::new(160, 64, |x, _| match x {
        0..80 => white(0.0),
        _ => Surface {
            velocity: [24.0, 0.0],
            ..BLACK_WALL
        },
    });
    let seen = |spread: &str| {
        let overrides = [
            ("mirror", "off"),
            ("spread", spread),
            ("direction", "ignored"),
        ];
        column(&picture.blurred("jimenez", "hdrp", &overrides), 80)
    };
    // One of eight taps is less than a step to the left, and counts for what is left of the step.
    assert!(seen("steps") > 0.03, "{}", seen("steps"));
    // What bilinear fetches mix into the half pixel at the edge.
    assert!(seen("late_steps") < 0.01, "{}", seen("late_steps"));
}

#[test]
fn tiles_around_end_long_smears_that_tiles_along_the_motion_carry() {
    // Half of 160 pixels to each side.
    let picture = Picture::new(
        320,
        64,
        |x, _| {
            if x < 160 { BLACK_WALL } else { white(160.0) }
        },
    );
    let reach = |preset: &str| {
        let output = picture.blurred("jimenez", preset, &[("tile_dither", "0")]);
        (0..160).filter(|x| column(&output, *x) > 0.0).count()
    };
    // One tile of 20 pixels beside the mover's.
    assert_eq!(reach("advanced_warfare"), 20);
    // All but the last pixels, which only the outermost taps reach.
    assert!(reach("hdrp") > 70, "{}", reach("hdrp"));
}

#[test]
fn tiles_along_the_motion_leave_those_beside_it_alone() {
    let picture = Picture::new(320, 160, |x, y| {
        if (x, y) == (160, 72) {
            white(100.0)
        } else {
            BLACK_WALL
        }
    });
    let overrides = [
        ("tile_size", "16"),
        ("tile_reach", "7"),
        ("dilation", "along_motion"),
    ];
    let tiles = picture.texture("jimenez", &overrides, "near_motion");
    let reached: Vec<(u32, u32)> = (0..10)
        .flat_map(|y| (0..20).map(move |x| (x, y)))
        .filter(|(x, y)| tiles.at(*x, *y)[0] > 0.0)
        .collect();
    // Half of 100 pixels to each side of tile (10, 4), wherever in it the mover is: four tiles, in its own row.
    let expected: Vec<(u32, u32)> = (6..=14).map(|x| (x, 4)).collect();
    assert_eq!(reached, expected);
}

#[test]
fn mirrored_weights_show_background_from_the_other_side() {
    // A black mover on the right; the wall is black for 4 pixels beside it and white beyond.
    let picture = Picture::new(160, 64, |x, _| match x {
        80.. => Surface {
            gray: 0.0,
            ..white(24.0)
        },
        _ => Surface {
            gray: if x < 76 { 1.0 } else { 0.0 },
            ..BLACK_WALL
        },
    });
    let seen = |mirror: &str| {
        let output = picture.blurred("jimenez", "advanced_warfare", &[("mirror", mirror)]);
        column(&output, 79)
    };
    // In all pairs the tap on the right reaches the mover; 8.5 of 12 pixels on the left are white, and half of the taps
    // are on the left. One tap more or less, a sixteenth.
    let expected = 0.5 * 8.5 / 12.0;
    assert!(
        (seen("slow_background") - expected).abs() < 1.0 / 16.0,
        "{} instead of {expected}",
        seen("slow_background")
    );
    // By itself a still background reaches nothing, but for the half pixel of bilinear fetches.
    assert!(seen("off") < 0.02, "{}", seen("off"));
}

#[test]
fn weighted_directions_leave_out_what_crosses_the_trail() {
    // On the right something white that moves down; around it everything moves right.
    let picture = Picture::new(160, 64, |x, _| match x {
        80.. => Surface {
            velocity: [0.0, 24.0],
            ..white(0.0)
        },
        _ => Surface {
            velocity: [25.0, 0.0],
            ..BLACK_WALL
        },
    });
    let seen = |direction: &str| {
        let overrides = [
            ("direction", direction),
            ("plain_tiles", "never"),
            ("mirror", "off"),
        ];
        column(&picture.blurred("jimenez", "hdrp", &overrides), 76)
    };
    // A third of the right half of the taps lies beyond 4 pixels of 12.
    assert!(seen("ignored") > 0.2, "{}", seen("ignored"));
    // What bilinear fetches mix into the half pixel at its edge.
    assert!(seen("weighted") < 0.01, "{}", seen("weighted"));
}

#[test]
fn plain_tiles_forget_depth_where_motions_are_alike() {
    // In front something white that moves 8 pixels, behind it 24: in their tiles the least is over a quarter.
    let picture = Picture::new(160, 64, |x, _| match x {
        80.. => white(8.0),
        _ => Surface {
            velocity: [24.0, 0.0],
            ..BLACK_WALL
        },
    });
    let seen = |plain: &str| {
        let overrides = [("plain_tiles", plain), ("mirror", "off")];
        column(&picture.blurred("jimenez", "hdrp", &overrides), 72)
    };
    // It comes 4 pixels to each side, and 8 are beyond a step of 3 more.
    assert!(seen("never") < 0.01, "{}", seen("never"));
    // A box of 24 pixels, of which 4.5 lie in it.
    assert!(
        (seen("similar") - 4.5 / 24.0).abs() < 0.03,
        "{}",
        seen("similar")
    );
}

#[test]
fn taps_off_the_picture_are_dropped_or_read_its_border() {
    // A white column at the border, in motion with everything else.
    let picture = Picture::new(80, 64, |x, _| Surface {
        gray: if x == 0 { 1.0 } else { 0.0 },
        velocity: [24.0, 0.0],
        depth: 2.0,
    });
    let seen = |border: &str| {
        let output = picture.blurred("jimenez", "kajiya", &[("border", border)]);
        column(&output, 4)
    };
    // Trails go 13.5 pixels to the left of 4.5: a third of the 27 reads the border, or one pixel of the 18 that are left.
    assert!(
        (seen("clamp") - 10.0 / 27.0).abs() < 0.05,
        "{}",
        seen("clamp")
    );
    assert!((seen("drop") - 1.0 / 18.0).abs() < 0.03, "{}", seen("drop"));
}
