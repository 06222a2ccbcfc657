//! The mirrored, depth-weighted family of Jimenez 2014.

use tests::picture::{BLACK_WALL, Picture, Surface, column, light, white};

const HONEST_LENGTHS: [&str; 3] = ["advanced_warfare", "hdrp", "kajiya"];

#[test]
fn a_mover_smears_half_its_motion_over_what_lies_behind() {
    let picture = Picture::new(
        160,
        64,
        |x, _| {
            if x < 80 { BLACK_WALL } else { white(24.0) }
        },
    );
    for preset in HONEST_LENGTHS {
        let output = picture.blurred("jimenez", preset, &[]);
        // A ramp from a half to nothing over 12 pixels holds 3 pixels of light; over kajiya's 13.5, nearly 3.4.
        let found = light(&output, 0..80);
        assert!((found - 3.0).abs() < 0.4, "{preset}: {found}");
        // Kajiya displaces pixels by up to a step, 3 pixels, and has half a step more on each side.
        assert!(light(&output, 0..60) < 0.01, "{preset}");
    }
}

#[test]
fn mirrored_weights_show_background_from_the_other_side() {
    // A black mover on the right; the wall is black for 4 pixels beside it and white beyond.
    let picture = Picture::new(160, 64, |x, _| match x {
        80.. => Surface {
            gray: 0.0,
            ..white(24.0)
        },
        _ => Surface {
            gray: if x < 76 { 1.0 } else { 0.0 },
            ..BLACK_WALL
        },
    });
    let seen = |mirror: &str| {
        let output = picture.blurred("jimenez", "advanced_warfare", &[("mirror", mirror)]);
        column(&output, 79)
    };
    // In all pairs the tap on the right reaches the mover; 8.5 of 12 pixels on the left are white, and half of the taps
    // are on the left. One tap more or less, a sixteenth.
    let expected = 0.5 * 8.5 / 12.0;
    assert!(
        (seen("slow_background") - expected).abs() < 1.0 / 16.0,
        "{} instead of {expected}",
        seen("slow_background")
    );
    // By itself a still background reaches nothing, but for the half pixel of bilinear fetches.
    assert!(seen("off") < 0.02, "{}", seen("off"));
}
