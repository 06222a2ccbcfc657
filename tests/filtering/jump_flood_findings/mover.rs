//! The leading edge of a mover.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, white};

/// Columns that the mover covers at the instant.
const MOVER_START: u32 = 80;
const MOVER_END: u32 = 140;
const SPEED: f64 = 21.0;
/// Brightness ahead of the mover.
const AHEAD: f64 = 0.25;
const BEHIND: f64 = 0.75;

/// Makes a white bar that moves right in front of a still background, which is darker ahead of the
/// bar than behind.
fn bar() -> Picture {
    Picture::new(240, 24, |x, _| match x {
        0..MOVER_START => BLACK_WALL.gray(BEHIND as f32),
        MOVER_START..MOVER_END => white(SPEED as f32),
        _ => BLACK_WALL.gray(AHEAD as f32),
    })
}

/// Returns the part of a column that shows the mover; the rest shows the background ahead.
fn share(x: u32) -> f64 {
    // Taps 3 pixels apart are on pixel centres.
    let output = bar().blur("jump_flood", "paper", "jitter=none");
    (column(&output, x) - AHEAD) / (1.0 - AHEAD)
}

#[test]
fn the_leading_edge_fades_and_does_not_stay_hard() {
    for inside in [1, 4, 10, 16, 20] {
        // The mover reached the middle of the column this many pixels before it stopped.
        let truth = (f64::from(inside) - 0.5) / SPEED;
        let actual = share(MOVER_END - inside);
        // The tolerance is one tap of eight.
        assert_near(actual, truth, 1.0 / 8.0);
    }
    assert_within(share(MOVER_END - 1), ..0.15);
    assert_eq!(share(MOVER_END), 0.0, "nothing came here yet");
}

#[test]
fn the_leading_part_takes_its_background_from_ahead() {
    let output = bar().blur("jump_flood", "paper", "jitter=none");
    // Seven of eight taps are beyond the edge; 32-bit floats.
    let expected = (1.0 + 7.0 * AHEAD) / 8.0;
    assert_near(column(&output, MOVER_END - 1), expected, 1e-5);
}
