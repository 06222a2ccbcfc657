//! Parity of ColorVideoVDP with its reference implementation, cvvdp 0.5.7, on synthetic clips.
//!
//! `fixtures/cvvdp/make.py` makes the same clips and stores the reference's answers.

use std::collections::BTreeMap;

use frame::{Image, Raster};
use metrics::video_jod;

/// An integer from 0 to 256 by column, row, frame and channel.
type Formula = fn(i64, i64, i64, i64) -> i64;

const FRAMES: i64 = 6;

fn base(x: i64, y: i64, k: i64, c: i64) -> i64 {
    96 + ((x + 300 - 3 * k) * (c + 2) + y * 3) % 64
}

fn noise(x: i64, y: i64, k: i64) -> i64 {
    (x * 73 + y * 151 + k * 211 + x * y * 7) % 33
}

const CASES: [(&str, Formula); 7] = [
    ("same", base),
    ("changing_noise", |x, y, k, c| {
        base(x, y, k, c) + noise(x, y, k) - 16
    }),
    ("standing_noise", |x, y, k, c| {
        base(x, y, k, c) + noise(x, y, 0) - 16
    }),
    ("brighter", |x, y, k, c| base(x, y, k, c) + 8),
    ("flicker", |x, y, k, c| base(x, y, k, c) + 8 * (k % 2)),
    ("late", |x, y, k, c| base(x, y, k - 1, c)),
    ("tinted", |x, y, k, c| {
        base(x, y, k, c) + 12 * i64::from(c == 0)
    }),
];

fn clip(formula: Formula) -> Vec<Image> {
    let frame = |k: i64| {
        Raster::from_fn(64, 48, |x, y| {
            [0, 1, 2].map(|c| formula(i64::from(x), i64::from(y), k, c) as f32 / 256.0)
        })
    };
    (0..FRAMES).map(frame).collect()
}

#[test]
fn jods_are_those_of_the_reference_implementation() {
    let expected: BTreeMap<String, f64> =
        serde_json::from_str(include_str!("../fixtures/cvvdp/cvvdp.json"))
            .expect("it holds numbers");
    let reference = clip(base);
    let mut compared = 0;
    for (display, per_second) in [("standard_fhd", 30.0), ("standard_4k", 60.0)] {
        for (name, formula) in CASES {
            let actual = video_jod(&clip(formula), &reference, display, per_second).unwrap();
            let expected = expected[&format!("{name} {} {per_second}", display)];
            // Both compute in 32 bits and add in another order.
            let off = (actual - expected).abs();
            assert!(off < 1e-3, "{name}: {actual}, expected {expected}");
            compared += 1;
        }
    }
    assert_eq!(compared, expected.len());
}
