//! The preset of kajiya.

use tests::near::assert_near;
use tests::picture::{Picture, column, white};

#[test]
fn taps_off_the_picture_are_dropped_or_read_its_border() {
    // A white column at the border, which moves with everything else.
    let picture = Picture::new(80, 64, |x, _| white(48.0).gray((x == 0).into()));
    let seen = |border: &str| {
        let output = picture.blur("jimenez", "kajiya", &format!("strength=-1 border={border}"));
        column(&output, 4)
    };
    // Two of seven taps, 3 pixels apart around 4.5, are off the picture; one is in the first three
    // columns.
    let one = 1.0 / 3.0;
    assert_near(seen("clamp"), (2.0 + one) / 7.0, 0.05);
    assert_near(seen("drop"), one / 5.0, 0.04);
}
