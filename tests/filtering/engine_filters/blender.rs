//! EEVEE, and Vector Blur of Blender's compositor.

use tests::near::assert_near;
use tests::picture::{BLACK_WALL, Picture, white};

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
