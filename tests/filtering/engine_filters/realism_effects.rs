//! The blur of realism-effects.

use tests::picture::{Picture, white};

#[test]
fn the_sky_stays_sharp_however_it_moves() {
    let sky = white(12.0).at(frame::FAR_DEPTH);
    let picture = Picture::new(40, 20, |x, _| sky.gray((x % 2) as f32));
    for filter in ["realism_effects", "babylon"] {
        assert!(picture.blur(filter, "default", "") == picture.color);
    }
}
