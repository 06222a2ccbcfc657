//! The preset of kajiya.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, light_above, slow_above_fast, white};

#[test]
fn kajiya_lets_things_smear_twice_as_far_as_they_move() {
    // The slow object should smear 12 * 3.5 / 16 = 2.6 pixels to each side; steps are 9 / 16
    // pixels.
    let picture = slow_above_fast(12.0, 48.0);
    let smear = |spread: &str| {
        let overrides = format!("strength=-1 pairs=16 spread={spread}");
        picture.blur("jimenez", "kajiya", &overrides)
    };
    // Three of 33 taps; half of them count.
    assert_within(light_above(&smear("pixels"), 3..5), 0.2..);
    // A pixel less than half its motion, and one pixel for fetches.
    assert_eq!(light_above(&smear("pixels"), 6..30), 0.0);
    // The smear ends within one step of its own length.
    assert_eq!(light_above(&smear("steps"), 3..30), 0.0);
}

#[test]
fn kajiya_shifts_taps_by_one_of_32_numbers() {
    // Brightness is the column, so a mean of taps is their mean position.
    let picture = Picture::new(256, 64, |x, _| white(-48.0).gray(x as f32));
    let output = picture.blur("jimenez", "kajiya", "strength=-1");
    let mut shifts: Vec<i32> = (64..192)
        .flat_map(|x| (0..64).map(move |y| (x, y)))
        // Taps are 3 pixels apart; the centre, one of seven, reads whole pixels.
        .map(|(x, y)| {
            let mean = output.at(x, y)[0] - x as f32;
            let distance = |shift: &i32| {
                let place = *shift as f32 * 0.1;
                let taps = (6.0 * place + (place + 0.5).floor()) / 7.0;
                ((taps - mean).abs() * 1e6) as i32
            };
            (-20..=20).min_by_key(distance).expect("there are some")
        })
        .collect();
    shifts.sort_unstable();
    shifts.dedup();
    // Noise shifts taps by -15 to 16 thirtieths of a step.
    assert_eq!(shifts, (-15..=16).collect::<Vec<_>>());
}

#[test]
fn kajiya_displaces_still_pixels_near_a_mover() {
    let picture = Picture::new(
        160,
        64,
        |_, y| if y < 40 { BLACK_WALL } else { white(48.0) },
    )
    .speckled(7, |_, y| y < 40);
    let changed = |overrides: &str| {
        let output = picture.blur("jimenez", "kajiya", &format!("strength=-1 {overrides}"));
        let wall = (0..38).flat_map(|y| (0..160).map(move |x| (x, y)));
        wall.filter(|(x, y)| (output.at(*x, *y)[0] - picture.color.at(*x, *y)[0]).abs() > 0.05)
            .count()
    };
    // The wall has 6080 pixels. Those in tiles that know the mover change if they shift by at least
    // half a pixel of 1.5.
    assert!(changed("") > 2000, "{}", changed(""));
    // Without noise the pixel does not shift, and a still pixel has no spread.
    assert_eq!(changed("noise=none"), 0);
}

#[test]
fn taps_off_the_picture_are_dropped_or_read_its_border() {
    // A white column at the border, which moves with everything else.
    let picture = Picture::new(80, 64, |x, _| white(48.0).gray((x == 0).into()));
    let seen = |border: &str| {
        let output = picture.blur("jimenez", "kajiya", &format!("strength=-1 border={border}"));
        column(&output, 4)
    };
    // Two of seven taps, 3 pixels apart around 4.5, are off the picture; one is in the first three
    // columns.
    let one = 1.0 / 3.0;
    assert_near(seen("clamp"), (2.0 + one) / 7.0, 0.05);
    assert_near(seen("drop"), one / 5.0, 0.04);
}
