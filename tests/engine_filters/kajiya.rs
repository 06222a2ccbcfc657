//! The preset of kajiya.

use tests::random::Random;

use tests::picture::{BLACK_WALL, Picture, Surface, column, light_above, slow_above_fast, white};

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
