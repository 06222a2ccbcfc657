//! Parity of FLIP with the reference tool, flip-evaluator 1.7, on synthetic pictures.
//!
//! `fixtures/flip/make.py` makes the same pictures and stores the tool's answers.

use std::collections::BTreeMap;

use frame::{FLIP_REACH, Image, Raster};
use metrics::{Viewing, flip_hdr, flip_ldr};
use serde::Deserialize;

/// An integer from 0 to 256 by column, row and channel.
type Formula = fn(u32, u32, u32) -> u32;

/// The reference tool's result for one pair.
#[derive(Deserialize)]
struct Expected {
    mean: f64,
    max: f64,
}

fn picture(formula: Formula, scale: f32, [width, height]: [u32; 2]) -> Image {
    Raster::from_fn(width, height, |x, y| {
        [0, 1, 2].map(|channel| formula(x, y, channel) as f32 / 256.0 * scale)
    })
}

const RAMP: Formula = |x, y, c| (x * (c + 2) + y * 3) % 257;
const SHIFTED_RAMP: Formula = |x, y, c| RAMP(x + 2, y, c);
const CHECKS: Formula = |x, y, c| {
    if (x / 6 + y / 5).is_multiple_of(2) {
        200 - 30 * c
    } else {
        40 + 20 * c
    }
};
const SMEARED_CHECKS: Formula = |x, y, c| (0..4).map(|tap| CHECKS(x + tap, y, c)).sum::<u32>() / 4;
const FLAT: Formula = |_, _, _| 128;
const FLAT_WITH_DOT: Formula = |x, y, _| if (x, y) == (30, 20) { 256 } else { 128 };
const DISC: Formula = |x, y, c| {
    if x.abs_diff(25).pow(2) + y.abs_diff(20).pow(2) < 150 {
        220 - 60 * c
    } else {
        0
    }
};
const MOVED_DISC: Formula = |x, y, c| DISC(x.saturating_sub(4), y.saturating_sub(1), c);
const SCATTER: Formula = |x, y, c| (x * 7919 + y * 104_729 + c * 1_299_709) % 251;
const BLACK: Formula = |_, _, _| 0;

/// First and last exposure in stops, and their number; none for a picture of a display.
type Exposures = Option<(f32, f32, u32)>;

const USUAL: [u32; 2] = [61, 43];
/// Fewer columns than the filters reach over.
const NARROW: [u32; 2] = [3, 70];

/// Name, reference, test, display white or scale, exposures, size.
type Pair = (&'static str, Formula, Formula, f32, Exposures, [u32; 2]);

#[rustfmt::skip]
const PAIRS: [Pair; 9] = [
    ("ldr_checks", CHECKS, SMEARED_CHECKS, 1.0, None, USUAL),
    ("ldr_dot", FLAT, FLAT_WITH_DOT, 1.0, None, USUAL),
    ("ldr_ramp", RAMP, SHIFTED_RAMP, 1.0, None, USUAL),
    ("ldr_scatter_bright", SCATTER, RAMP, 4.0, None, USUAL),
    ("hdr_black_reference", BLACK, DISC, 1.0, Some((-2.0, 2.0, 3)), USUAL),
    ("hdr_checks_bright", CHECKS, SMEARED_CHECKS, 16.0, Some((-6.0, 2.0, 5)), USUAL),
    ("hdr_disc_on_black", DISC, MOVED_DISC, 4.0, Some((-4.0, 4.0, 9)), USUAL),
    ("hdr_near_black", SCATTER, CHECKS, 1.0 / 1024.0, Some((-1.0, 10.0, 12)), USUAL),
    ("ldr_narrow", SCATTER, RAMP, 1.0, None, NARROW),
];

#[test]
fn flip_equals_the_reference_tool() {
    let expected: BTreeMap<String, Expected> =
        serde_json::from_str(include_str!("../fixtures/flip/flip.json")).expect("it holds numbers");
    assert_eq!(expected.len(), PAIRS.len());
    for (name, reference, test, scale, exposures, size) in PAIRS {
        let (flip_start, flip_stop, flip_count) = exposures.unwrap_or((0.0, 0.0, 2));
        let (flip, stops): (fn(&Image, &Image, &Viewing) -> _, f32) = match exposures {
            Some(_) => (flip_hdr, 0.0),
            None => (flip_ldr, -scale.log2()),
        };
        let viewing = Viewing {
            stops,
            flip_start,
            flip_stop,
            flip_count,
        };
        let [reference, test] = [reference, test].map(|formula| picture(formula, scale, size));
        let map = flip(&reference, &test, &viewing);
        let sum: f64 = map.pixels.iter().map(|error| f64::from(*error)).sum();
        let mean = sum / map.pixels.len() as f64;
        let max = f64::from(map.pixels.iter().copied().fold(0.0, f32::max));
        // Both compute in 32 bits, and their rounding grows to about 1e-7 through FLIP's powers. A
        // wrong constant makes 1e-4. Single pixels round more than the mean does.
        let Expected {
            mean: due,
            max: due_max,
        } = expected[name];
        let off = (mean - due).abs();
        assert!(off <= 1e-6, "{name}: mean {mean}, the tool says {due}");
        let off = (max - due_max).abs();
        assert!(off <= 1e-5, "{name}: max {max}, not {due_max}");
    }
}

/// Pictures are filtered in blocks of 64 columns and bands of 64 rows, whose places a part changes.
#[test]
fn a_part_of_a_picture_has_the_errors_of_the_whole_bit_for_bit() {
    const LEFT: u32 = 37;
    const TOP: u32 = 29;
    let viewing = Viewing {
        stops: 0.5,
        flip_start: -2.0,
        flip_stop: 2.0,
        flip_count: 5,
    };
    let pictures = [RAMP, SHIFTED_RAMP].map(|formula| picture(formula, 2.0, [150, 210]));
    let parts = pictures.each_ref().map(|whole| {
        Raster::from_fn(100, 170, |x, y| {
            whole.pixels[((y + TOP) * whole.width + x + LEFT) as usize]
        })
    });
    for flip in [flip_ldr, flip_hdr] {
        let whole = flip(&pictures[0], &pictures[1], &viewing);
        let part = flip(&parts[0], &parts[1], &viewing);
        for y in FLIP_REACH..part.height - FLIP_REACH {
            for x in FLIP_REACH..part.width - FLIP_REACH {
                let of_part = part.pixels[(y * part.width + x) as usize];
                let of_whole = whole.pixels[((y + TOP) * whole.width + x + LEFT) as usize];
                assert_eq!(of_part, of_whole, "at ({x}, {y})");
            }
        }
    }
}
