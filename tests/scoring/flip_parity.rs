//! Parity of FLIP with the reference tool, flip-evaluator 1.7, on pictures made by formula.
//!
//! `fixtures/flip/make.py` makes the same pictures and stores the tool's answers.

use std::collections::BTreeMap;

use frame::{Image, Plane, Raster};
use metrics::{Viewing, flip_hdr, flip_ldr};
use serde::Deserialize;

/// An integer from 0 to 256 by column, row and channel.
type Formula = fn(u32, u32, u32) -> u32;

/// Answer of the reference tool about one pair.
#[derive(Deserialize)]
struct Expected {
    mean: f64,
    max: f64,
}

fn read_expected() -> BTreeMap<String, Expected> {
    serde_json::from_str(include_str!("../fixtures/flip/flip.json"))
        .expect("flip.json holds numbers")
}

fn picture(formula: Formula, scale: f32) -> Image {
    Raster::from_fn(61, 43, |x, y| {
        [0, 1, 2].map(|channel| formula(x, y, channel) as f32 / 256.0 * scale)
    })
}

fn ramp(x: u32, y: u32, c: u32) -> u32 {
    (x * (c + 2) + y * 3) % 257
}

fn shifted_ramp(x: u32, y: u32, c: u32) -> u32 {
    ramp(x + 2, y, c)
}

fn checks(x: u32, y: u32, c: u32) -> u32 {
    if (x / 6 + y / 5).is_multiple_of(2) {
        200 - 30 * c
    } else {
        40 + 20 * c
    }
}

fn smeared_checks(x: u32, y: u32, c: u32) -> u32 {
    (0..4).map(|tap| checks(x + tap, y, c)).sum::<u32>() / 4
}

fn flat(_: u32, _: u32, _: u32) -> u32 {
    128
}

fn flat_with_dot(x: u32, y: u32, _: u32) -> u32 {
    if (x, y) == (30, 20) { 256 } else { 128 }
}

fn disc_at(x: u32, y: u32, c: u32, center: [u32; 2]) -> u32 {
    let [right, down] = [x.abs_diff(center[0]), y.abs_diff(center[1])];
    if right * right + down * down < 150 {
        220 - 60 * c
    } else {
        0
    }
}

fn disc(x: u32, y: u32, c: u32) -> u32 {
    disc_at(x, y, c, [25, 20])
}

fn moved_disc(x: u32, y: u32, c: u32) -> u32 {
    disc_at(x, y, c, [29, 21])
}

fn scatter(x: u32, y: u32, c: u32) -> u32 {
    (x * 7919 + y * 104_729 + c * 1_299_709) % 251
}

fn black(_: u32, _: u32, _: u32) -> u32 {
    0
}

fn assert_equal(name: &str, map: &Plane) {
    let expected = &read_expected()[name];
    let sum: f64 = map.pixels.iter().map(|error| f64::from(*error)).sum();
    let mean = sum / map.pixels.len() as f64;
    let max = f64::from(map.pixels.iter().copied().fold(0.0, f32::max));
    // Both compute in 32 bits, whose rounding grows to about 1e-7 through FLIP's powers. A wrong constant shows at
    // 1e-4.
    assert!(
        (mean - expected.mean).abs() <= 1e-6,
        "{name}: mean {mean}, the tool says {}",
        expected.mean
    );
    // Single pixels round more than the mean does.
    assert!(
        (max - expected.max).abs() <= 1e-5,
        "{name}: max {max}, the tool says {}",
        expected.max
    );
}

/// Name, reference, test, display white.
const LDR: [(&str, Formula, Formula, f32); 4] = [
    ("ldr_checks", checks, smeared_checks, 1.0),
    ("ldr_dot", flat, flat_with_dot, 1.0),
    ("ldr_ramp", ramp, shifted_ramp, 1.0),
    ("ldr_scatter_bright", scatter, ramp, 4.0),
];

/// First and last exposure in stops, and their number.
type Exposures = (f32, f32, u32);

/// Name, reference, test, scale, exposures.
const HDR: [(&str, Formula, Formula, f32, Exposures); 4] = [
    ("hdr_black_reference", black, disc, 1.0, (-2.0, 2.0, 3)),
    (
        "hdr_checks_bright",
        checks,
        smeared_checks,
        16.0,
        (-6.0, 2.0, 5),
    ),
    ("hdr_disc_on_black", disc, moved_disc, 4.0, (-4.0, 4.0, 9)),
    (
        "hdr_near_black",
        scatter,
        checks,
        1.0 / 1024.0,
        (-1.0, 10.0, 12),
    ),
];

#[test]
fn ldr_flip_equals_the_reference_tool() {
    for (name, reference, test, white) in LDR {
        let viewing = Viewing {
            stops: -white.log2(),
            flip_start: 0.0,
            flip_stop: 0.0,
            flip_count: 2,
        };
        let map = flip_ldr(&picture(reference, white), &picture(test, white), &viewing);
        assert_equal(name, &map);
    }
}

#[test]
fn hdr_flip_equals_the_reference_tool() {
    for (name, reference, test, scale, (start, stop, count)) in HDR {
        let viewing = Viewing {
            stops: 0.0,
            flip_start: start,
            flip_stop: stop,
            flip_count: count,
        };
        let map = flip_hdr(&picture(reference, scale), &picture(test, scale), &viewing);
        assert_equal(name, &map);
    }
}

#[test]
fn every_stored_number_is_compared() {
    let stored: Vec<String> = read_expected().into_keys().collect();
    let hdr = HDR.iter().map(|pair| pair.0);
    let compared: Vec<&str> = hdr.chain(LDR.iter().map(|pair| pair.0)).collect();
    assert_eq!(stored, compared);
}
