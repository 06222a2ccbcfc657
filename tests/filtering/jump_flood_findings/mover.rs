//! The leading edge of a mover.

use tests::picture::{Picture, Surface, column, white};

/// Columns that the mover covers at the instant.
const MOVER: std::ops::Range<u32> = 80..140;
const SPEED: f64 = 21.0;
/// Brightness ahead of the mover.
const AHEAD: f64 = 0.25;
const BEHIND: f64 = 0.75;

/// Makes a white bar that moves right in front of something still, which is darker ahead of the bar than behind.
fn bar() -> Picture {
    Picture::new(240, 24, |x, _| match x {
        x if MOVER.contains(&x) => white(SPEED as f32),
        _ => Surface {
            gray: if x < MOVER.start { BEHIND } else { AHEAD } as f32,
            velocity: [0.0, 0.0],
            depth: 20.0,
        },
    })
}

/// Returns the part of a column that shows the mover; the rest shows the background ahead.
fn share(x: u32) -> f64 {
    // Taps 3 pixels apart lie on pixel centres.
    let output = bar().blur("jump_flood", "paper", &[("jitter", "none")]);
    (column(&output, x) - AHEAD) / (1.0 - AHEAD)
}

#[test]
fn the_leading_edge_fades_and_does_not_stay_hard() {
    for inside in [1, 4, 10, 16, 20] {
        // The mover reached the middle of the column this many pixels before it stopped.
        let truth = (f64::from(inside) - 0.5) / SPEED;
        let found = share(MOVER.end - inside);
        // One tap of eight.
        assert!(
            (found - truth).abs() < 1.0 / 8.0,
            "{inside}: {found}, {truth}"
        );
    }
    assert!(share(MOVER.end - 1) < 0.15, "{}", share(MOVER.end - 1));
    assert_eq!(share(MOVER.end), 0.0, "nothing came here yet");
}

#[test]
fn the_leading_part_takes_its_background_from_ahead() {
    let output = bar().blur("jump_flood", "paper", &[("jitter", "none")]);
    // Seven of eight taps lie beyond the edge; 32-bit floats.
    let expected = (1.0 + 7.0 * AHEAD) / 8.0;
    let found = column(&output, MOVER.end - 1);
    assert!((found - expected).abs() < 1e-5, "{found}, {expected}");
}
