//! Precision that the version of two days later loses with its 16-bit map of sources.

use tests::near::assert_within;
use tests::picture::{Picture, column, white};

/// Returns the brightness of the first pixel of a still wall next to a mover; the wall is white
/// from the next pixel on.
fn beside_a_mover(map: &str) -> f64 {
    let picture = Picture::new(200, 24, |x, _| match x {
        0..80 => white(40.0),
        80 => white(0.0).gray(0.0),
        _ => white(0.0),
    });
    let overrides = format!("jitter=none map={map}");
    column(&picture.blur("jump_flood", "july_2024", &overrides), 80)
}

#[test]
fn a_map_of_16_bits_moves_still_pixels_beside_a_mover() {
    // The pixel's only source is itself, and it is still.
    assert_eq!(beside_a_mover("float32"), 0.0);
    // The pixel's position, 80.5 of 200 pixels, is stored as 80.47. A linear fetch there mixes in 3
    // % of the mover's 40 pixels.
    assert_within(beside_a_mover("float16"), 0.05..);
}
