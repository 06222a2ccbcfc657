//! KinoMotion.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, moving_edge, white};

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
fn packed_motion_has_steps_and_no_zero() {
    let picture = Picture::new(64, 360, |x, _| {
        BLACK_WALL.moving(2.0 * x as f32 / 100.0, 0.0)
    });
    // 5 % of 360 rows are 18 pixels.
    let step = 2.0 * 18.0 / 1023.0;
    let packed = picture.texture("kino", "", "motion");
    // Zero is half-way between two of 1024 values.
    let still = packed.at(0, 7);
    assert_near(still[0], 0.5 * step, 1e-5);
    assert_near(still[1], 0.5 * step, 1e-5);
    for x in 0..64 {
        let value = f64::from(packed.at(x, 7)[0]);
        let steps = value / step - 0.5;
        assert_near(steps, steps.round(), 1e-3);
        // Half of the motion, to the nearest step; 1e-5 for rounding.
        assert_near(value, f64::from(x) / 100.0, 0.5 * step + 1e-5);
    }
    let exact = picture.texture("kino", "storage=exact", "motion");
    assert_eq!(exact.at(0, 7)[0], 0.0);
    // A depth of 20 metres, of 1000, to the nearest of 1024 values.
    assert_eq!(packed.at(0, 7)[2], 20.0 / 1023.0);
}

#[test]
fn a_tile_is_the_radius_rounded_up_to_eight() {
    for (rows, tile) in [(180, 16), (360, 24), (480, 24), (481, 24), (500, 32)] {
        println!("{rows} rows");
        let picture = Picture::new(130, rows, |x, y| match (x, y) {
            (100, 50) => white(400.0),
            _ => BLACK_WALL,
        });
        let overrides = "storage=exact tiles=partial";
        let tiles = picture.texture("kino", overrides, "tile_max");
        let radius = (rows * 5 / 100) as f32;
        let [column, row] = [100 / tile, 50 / tile];
        // Motion is cut at the radius.
        assert_near(tiles.at(column, row)[0], radius, 1e-4);
        let moving = tiles.pixels.iter().filter(|motion| motion[0] > 0.0).count();
        assert_eq!(moving, 1);
        // A tile's own motion counts 1.01 times, so neighbours' motion arrives shorter by that
        // factor.
        let near = picture.texture("kino", overrides, "neighbor_max");
        assert_near(near.at(column, row)[0], radius, 1e-4);
        assert_near(near.at(column - 1, row)[0], radius / 1.01, 1e-4);
    }
}

#[test]
fn half_motion_under_two_pixels_stays_sharp() {
    for (speed, blurs) in [(3.9, false), (4.1, true)] {
        let picture = moving_edge(60, 360, [speed, 0.0]);
        let output = picture.blur("kino", "default", "storage=exact");
        assert_eq!(output != picture.color, blurs, "{speed} pixels per frame");
    }
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
