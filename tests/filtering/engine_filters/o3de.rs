//! The preset of the Open 3D Engine.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, moving_edge, white};

#[test]
fn o3de_cuts_offsets_to_whole_pixels() {
    // 1.05 pixels to each side.
    let picture = moving_edge(60, 64, [2.1, 0.0]);
    let seen = |placement: &str| {
        let overrides = format!("placement={placement}");
        column(&picture.blur("jimenez", "o3de", &overrides), 29)
    };
    // At the edge, at most two of 24 pairs reach a whole pixel.
    assert_within(seen("whole_pixels"), ..=2.0 / 48.0);
    // Half of the taps lie 0.5 pixels to the right on average.
    assert_near(seen("middles"), 0.25, 0.03);
}

/// Makes a still white post at 60..70 in front of a black wall; from row 40 on, a black surface
/// moves in front of both.
fn post_above_motion() -> Picture {
    Picture::new(160, 64, |x, y| match (x, y) {
        (_, 40..) => white(240.0).gray(0.0),
        (60..70, _) => white(0.0),
        _ => BLACK_WALL,
    })
}

#[test]
fn o3de_keeps_the_sign_of_its_innermost_offset() {
    let output = post_above_motion().blur("jimenez", "o3de", "pairs=24");
    // Next to the post, and in odd rows, taps are at i - 1/4 steps of 5 pixels, cut: -1, 3, 8 ..
    // and the same to the left. The first tap on the post is at -1/4 steps, within a still object's
    // spread of one step: it counts whole. At 3/4 steps it counts a quarter, and farther ones do
    // not count.
    for row in [37, 39] {
        assert_near(output.at(70, row)[0], (1.0 + 0.25) / 48.0, 1e-5);
    }
}

#[test]
fn o3de_mixes_still_things_near_a_mover_with_their_background() {
    let picture = post_above_motion();
    // The rows above the mover, within reach of its tiles.
    let darkest = |overrides: &str| {
        let output = picture.blur("jimenez", "o3de", overrides);
        let post = (22..38).flat_map(|y| (60..70).map(move |x| (x, y)));
        post.map(|(x, y)| output.at(x, y)[0]).fold(1.0, f32::min)
    };
    assert_within(darkest(""), ..0.5);
    // With the pixel's own motion in place of the tile's, only taps within a step of a still pixel
    // count: one pair of 24.
    assert_within(darkest("spread=steps"), 0.9..);
}
