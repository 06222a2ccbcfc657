//! The blur of the Bevy engine.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, moving_edge, white};

#[test]
fn a_surface_in_front_counts_by_its_motion_over_a_whole_frame() {
    // A black background moves right, with a white surface in front of its right half. The
    // background's taps reach 5 pixels to each side.
    let seen = |speed: f32| {
        let mut picture = Picture::halves(120, 64, BLACK_WALL.moving(40.0, 0.0), white(speed));
        picture.exposure = 0.25;
        column(&picture.blur("bevy", "high", ""), 57)
    };
    // An object that moves 20 pixels in a frame moves 2.5 to each side while the shutter is open.
    // Yet at 2.5 pixels from it, all of the trail that it covers counts: a quarter.
    assert_near(seen(20.0), 0.25, 0.05);
    // A slower object moves 2 pixels in half a whole frame. It does not count, except in the half
    // pixel at its edge, where a bilinear fetch mixes its motion with the background's.
    assert_within(seen(4.0), ..0.08);
}

#[test]
fn motion_below_a_pixel_stays_sharp_at_every_exposure() {
    for (speed, blurs) in [(0.99, false), (1.01, true)] {
        let mut picture = moving_edge(40, 16, [speed, 0.0]);
        picture.exposure = 4.0;
        let output = picture.blur("bevy", "high", "");
        assert_eq!(output != picture.color, blurs, "{speed} pixels per frame");
    }
}

#[test]
fn the_sky_counts_at_any_motion() {
    let seen = |depth: f32| {
        let [ground, sky] =
            [BLACK_WALL.moving(24.0, 0.0), white(0.0)].map(|surface| surface.at(depth));
        let picture = Picture::halves(120, 64, ground, sky);
        column(&picture.blur("bevy", "high", ""), 56)
    };
    // 8.5 of the trail's 24 pixels are beyond the edge; one tap of 16 more or less.
    assert_near(seen(frame::FAR_DEPTH), 8.5 / 24.0, 1.0 / 16.0);
    // A still wall at the same depth has no motion; bilinear fetches mix motions in the half pixel
    // at the edge.
    assert_within(seen(20.0), ..0.05);
}

#[test]
fn taps_off_the_picture_are_skipped() {
    // A white column at the border, which moves with everything else.
    let picture = Picture::new(80, 64, |x, _| white(24.0).gray((x == 0).into()));
    // 12 pixels of the trail are to the left of 4.5, and 16.5 pixels of it are on the picture, one
    // of them the white column. Clamped taps would make it 8.5 of 24.
    let output = picture.blur("bevy", "high", "");
    assert_near(column(&output, 4), 1.0 / 16.5, 0.03);
}
