//! Dagor Engine's blur.

use frame::FAR_DEPTH;
use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, light, white};

#[test]
fn the_vignette_shortens_smears_in_the_middle_to_a_sixth() {
    let picture = Picture::uniform(161, 91, white(24.0));
    let half_motion = |changes: &str, x, y| {
        let [_, _, length, _] = *picture.texture("dagor", changes, "surfaces").at(x, y);
        f64::from(length)
    };
    for (x, y, expected) in [(80, 45, 12.0 * 0.4 * 0.4), (0, 45, 12.0), (80, 0, 12.0)] {
        // Lengths have six bits after the first.
        assert_near(half_motion("", x, y), expected, expected / 64.0);
        assert_eq!(half_motion("vignette=0", x, y), 12.0);
    }
}

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

#[test]
fn what_is_before_the_sky_takes_none_of_its_light() {
    let sky = BLACK_WALL.at(FAR_DEPTH).gray(1.0);
    let picture = Picture::halves(160, 48, white(24.0).gray(0.0), sky);
    let taken = |changes: &str| light(&picture.blur("dagor", "mended", changes), 0..80);
    // Only fetches between the mover's last pixel and the sky's first one take some of its light.
    assert_within(taken(""), ..0.2);
    // Cones on the sky against cylinders on the mover let through about a twentieth of the trail.
    assert_near(taken("sky=counts"), 24.0 / 20.0, 0.4);
}
