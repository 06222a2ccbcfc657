//! Precision that the map of sources loses in 16 bits, in the version of two days later.

use tests::picture::{Picture, Surface, column, white};

/// Brightness of the first pixel of a wall that stands still beside a mover; the wall is white from the next pixel on.
fn beside_a_mover(map: &str) -> f64 {
    let wall = |gray: f32| Surface { gray, ..white(0.0) };
    let picture = Picture::new(200, 24, |x, _| match x {
        0..80 => white(40.0),
        80 => wall(0.0),
        _ => wall(1.0),
    });
    let overrides = [("jitter", "none"), ("map", map)];
    column(&picture.blurred("jump_flood", "july_2024", &overrides), 80)
}

#[test]
fn a_map_of_16_bits_moves_what_stands_still_beside_a_mover() {
    // It has no source but itself, and stands still.
    assert_eq!(beside_a_mover("float32"), 0.0);
    // Its place, 80.5 of 200 pixels, is held as 80.47, where a linear fetch mixes 3 % of the mover's 40 pixels in.
    let found = beside_a_mover("float16");
    assert!(found > 0.05, "{found}");
}
