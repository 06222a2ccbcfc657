//! Dagor Engine's blur.

use tests::picture::{Picture, white};

#[test]
fn a_tap_beyond_the_border_reads_the_motion_at_the_opposite_border() {
    // A tap off the left border reads the motion of the last columns.
    let picture = |last: f32| {
        Picture::new(160, 48, |x, _| match x {
            150.. => white(last),
            _ => white(24.0).gray((x % 2) as f32),
        })
    };
    let at_border = |changes: &str, last: f32| {
        let output = picture(last).blur("dagor", "mended", changes);
        (0..48).map(|y| *output.at(1, y)).collect::<Vec<_>>()
    };
    assert_ne!(at_border("", 0.0), at_border("", 24.0));
    let clamped = [0.0, 24.0].map(|last| at_border("border=clamp", last));
    assert_eq!(clamped[0], clamped[1]);
}
