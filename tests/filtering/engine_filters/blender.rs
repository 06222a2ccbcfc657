//! EEVEE, and Vector Blur of Blender's compositor.

use frame::Image;
use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, white};

#[test]
fn the_compositor_overlooks_movers_above_a_border_of_tiles() {
    // Tiles have 32 pixels, and rows count from below. The mover's tile begins at its lowest row,
    // 64.
    let picture = Picture::new(96, 96, |x, y| match (x, y) {
        (32..64, 0..32) => white(24.0),
        _ => BLACK_WALL,
    });
    let light = |output: &Image, rows_above: std::ops::Range<u32>| -> f64 {
        let pixels = rows_above.flat_map(|row| (64..72).map(move |x| (x, 31 - row)));
        pixels.map(|(x, y)| f64::from(output.at(x, y)[0])).sum()
    };
    let [shipped, mended] =
        ["", "tile_shift=around"].map(|change| picture.blur("blender", "compositor", change));
    // Without brackets, noise looks 6 or 7 pixels lower.
    assert_eq!(light(&shipped, 0..6), 0.0);
    assert_within(light(&shipped, 7..13), 1.0..);
    // With brackets, noise looks up to 8 pixels higher or lower.
    assert_within(light(&mended, 0..6), 0.6 * light(&mended, 9..15)..);
}

#[test]
fn eevee_compares_the_motion_of_a_tile_in_whole_pixels() {
    // Halves of these: 3.9 and 3.2 pixels.
    let picture = Picture::new(32, 32, |x, y| match (x, y) {
        (16, 10) => white(7.8),
        (16, 4) => white(6.4),
        _ => BLACK_WALL,
    });
    let longest = |rule: &str| {
        let tiles = picture.texture("blender", &format!("tile_rule={rule}"), "tile_motion");
        let [opening, _, closing, _] = *tiles.at(0, 0);
        assert_eq!(opening, -closing);
        closing
    };
    // Of two motions that round to the same length, that of the highest row counts.
    assert_near(longest("clipped"), 3.2, 1e-5);
    assert_near(longest("whole"), 3.9, 1e-5);
}

#[test]
fn eevee_ends_the_motion_of_tiles_at_the_border() {
    let picture = Picture::new(64, 32, |x, y| match (x, y) {
        (10, 16) => white(100.0),
        _ => BLACK_WALL,
    });
    let tiles = picture.texture("blender", "", "tile_motion");
    let [opening, _, closing, _] = *tiles.at(0, 0);
    // The opening's motion ends at the border, 10.5 pixels from the pixel's middle. The closing's
    // is half of 100 pixels.
    assert_near(opening, -10.5, 1e-4);
    assert_near(closing, 50.0, 1e-4);
}
