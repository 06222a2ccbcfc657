//! The preset of Unity HDRP.

use tests::random::Random;

use tests::picture::{BLACK_WALL, Picture, Surface, column, light, white};

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
fn late_steps_are_steps_from_the_first_whole_one_on() {
    let picture = still_in_front();
    let output = |placement: &str, spread: &str| {
        let overrides = [
            ("placement", placement),
            ("spread", spread),
            ("noise", "none"),
        ];
        picture.blurred("jimenez", "hdrp", &overrides)
    };
    // Taps at the ends of steps lie one step away or more.
    assert!(output("ends", "late_steps") == output("ends", "steps"));
    assert!(output("middles", "late_steps") != output("middles", "steps"));
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
