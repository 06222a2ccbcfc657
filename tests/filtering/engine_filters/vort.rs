//! vort's motion blur for ReShade.

use tests::near::assert_near;
use tests::picture::{BLACK_WALL, Picture, light, white};

#[test]
fn a_mover_closer_than_half_a_metre_to_what_is_behind_it_smears_in_part() {
    let picture = Picture::halves(160, 54, white(8.0), BLACK_WALL.at(2.3));
    let [shipped, finer] = ["", "depth_scale=1000"].map(|change| {
        let output = picture.blur("vort", "default", change);
        light(&output, 80..160)
    });
    // ReShade's depth of 2 and 2.3 metres, from a near plane at 0.1.
    let [mover, wall] = [2.0, 2.3].map(|metres| (metres - 0.1) / (metres + 99.9));
    // Taps between the two read a depth between both.
    assert_near(shipped / finer, 0.5 + 100.0 * (wall - mover), 0.02);
}
