//! KinoMotion.

use tests::near::assert_within;
use tests::picture::{BLACK_WALL, Picture, column, white};

/// Makes a white bar of 40 pixels that moves right, in the right or left half of a still black
/// picture.
fn bar(right: bool) -> Picture {
    Picture::new(160, 64, |x, _| {
        let from_middle = if right { x as i32 - 80 } else { 79 - x as i32 };
        match from_middle {
            0..40 => white(40.0),
            _ => BLACK_WALL,
        }
    })
}

#[test]
fn the_order_of_taps_makes_a_mover_s_two_sides_differ() {
    let overrides = "jitter=none storage=exact radius_percent=40";
    // The still pixels next to the bar: 1 to 18 of the 20 that its smear covers.
    let light = |is_right: bool, pixel: fn(u32) -> u32| -> f64 {
        let output = bar(is_right).blur("kino", "default", overrides);
        (0..18).map(|i| column(&output, pixel(i))).sum()
    };
    // The right tap is the first of each pair. If the bar is read first, the background counts as
    // moving as far, and the bar's own share shrinks. Without this order both sides would be equal
    // up to rounding.
    assert_within(light(true, |i| 79 - i), ..0.97 * light(false, |i| 80 + i));
}

#[test]
fn each_pixel_belongs_to_one_block_of_any_size() {
    // Column 42 and row 21 have a different position in every halving of the picture.
    let picture = Picture::new(128, 64, |x, y| match (x, y) {
        (42, 21) => white(4.0),
        _ => BLACK_WALL,
    });
    for side in [1, 2, 4, 8, 16, 32, 64] {
        let changes = format!("storage=exact block_size={side}");
        let blocks = picture.texture("kino", &changes, "block_max");
        let places = (0..64 / side).flat_map(|y| (0..128 / side).map(move |x| (x, y)));
        let moving = places.filter(|(x, y)| blocks.at(*x, *y)[0] > 0.0);
        assert!(moving.eq([(42 / side, 21 / side)]), "side {side}");
    }
}

#[test]
fn a_tap_is_foreground_from_a_twentieth_of_the_depth_on() {
    let output = |depth| {
        let bar = Picture::halves(120, 40, BLACK_WALL, white(24.0).at(depth));
        bar.blur("kino", "default", "storage=exact radius_percent=40")
    };
    // The wall is 20 metres away.
    assert!(output(18.99) == output(2.0));
    assert!(output(19.01) != output(2.0));
}
