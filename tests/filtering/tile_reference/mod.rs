//! Tile filters on the GPU against their papers in 64-bit floats. Each pass gets the previous
//! pass's output.

mod guertin;
mod mcguire;
mod published;
mod tiles;

use std::sync::LazyLock;

use filters::Value;
use tests::kernels::half_velocity;
use tests::vector::{Vec2, length};
use tiles::{Tiles, texel, vector};

use crate::reference::{Case, Run, run_cases};

/// Changes to the presets `paper`. At an exposure of 1, most motion is cut at the side of a tile;
/// at 0.3, little is; at 0.05, most of it is less than half a pixel.
#[rustfmt::skip]
const CASES: [Case; 9] = [
    ("mcguire", "paper", "", 1.0),
    ("mcguire", "paper", "tile_size=7 samples=9", 0.3),
    ("mcguire", "paper", "jitter=none samples=8", 0.5),
    ("mcguire", "paper", "tile_size=90 soft_extent=3", 0.05),
    ("guertin", "paper", "", 1.0),
    ("guertin", "paper", "tile_size=7 samples=9", 0.3),
    ("guertin", "paper", "tile_size=12 neighbor_rule=all jitter=0", 0.5),
    ("guertin", "paper", "tile_size=16 neighbor_rule=either_way split=alternate", 0.7),
    ("guertin", "paper", "tile_size=90 tile_blend=0", 0.05),
];

static RUNS: LazyLock<Vec<Run>> =
    LazyLock::new(|| run_cases(&CASES, &["motion", "tiles", "neighborhoods"]));

/// 16 rounding steps of a 32-bit float: a length is a sum of two squares and a root.
const ROUNDING: f64 = 16.0 * 6e-8;

/// Error of the gradient noise in 32-bit floats: 53 times the rounding of a number up to 64, twice.
const NOISE: f64 = 4e-4;

/// Reference for a pixel: its colour and the error that 32-bit noise may cause; none if rounding
/// decides which texel is read.
type Reference = fn(&Run, [i64; 2]) -> Option<([f64; 3], f64)>;

/// Returns the half-velocity that the first pass wrote, in pixels.
fn motion(run: &Run, pixel: [i64; 2]) -> Vec2 {
    vector(run.texture("motion"), pixel)
}

fn depth(run: &Run, [x, y]: [i64; 2]) -> f64 {
    (*run.field.depth.at(x as u32, y as u32)).into()
}

fn color(run: &Run, [x, y]: [i64; 2]) -> [f64; 3] {
    run.field.color.at(x as u32, y as u32).map(f64::from)
}

fn tiles(run: &Run) -> Tiles<'_> {
    Tiles {
        side: run.integer("tile_size"),
        image: run.size(),
        vectors: run.texture("tiles"),
    }
}

#[test]
fn half_velocities_equal_the_papers() {
    let (mut still, mut slow, mut free, mut cut) = (0, 0, 0, 0);
    for run in RUNS.iter() {
        for pixel in run.pixels() {
            let full = run.field.velocity.at(pixel[0] as u32, pixel[1] as u32);
            let half = full.map(|component| 0.5 * run.field.exposure * f64::from(component));
            let longest = run.integer("tile_size") as f64;
            let expected = half_velocity(half, longest);
            let actual = motion(run, pixel);
            let is_near =
                |axis: usize| (actual[axis] - expected[axis]).abs() <= ROUNDING * length(expected);
            assert!(
                (0..2).all(is_near),
                "{}: pixel {pixel:?} is {actual:?}; the reference says {expected:?}",
                run.name
            );
            match length(half) {
                0.0 => still += 1,
                speed if speed < 0.5 => slow += 1,
                speed if speed > longest => cut += 1,
                _ => free += 1,
            }
        }
    }
    // Each case of the formula occurs often.
    let least = [still, slow, free, cut].into_iter().min().unwrap();
    assert!(least > 1000, "{still} {slow} {free} {cut}");
}

#[test]
fn full_and_partial_tiles_hold_their_longest_half_velocity() {
    for run in RUNS.iter() {
        let (tiles, held) = (tiles(run), run.texture("tiles"));
        let count = [held.width, held.height].map(i64::from);
        assert_eq!(count, tiles.count(), "{}", run.name);
        for tile in tiles.all() {
            let motion: Vec<Vec2> = tiles.pixels(tile).map(|pixel| motion(run, pixel)).collect();
            let lengths = || motion.iter().copied().map(length);
            let (shortest, longest) = (
                lengths().fold(f64::INFINITY, f64::min),
                lengths().fold(0.0, f64::max),
            );
            let actual = vector(held, tile);
            // Cut motion has one length, so a correct run may choose any of the longest.
            assert!(
                motion.contains(&actual) && length(actual) >= longest * (1.0 - ROUNDING),
                "{}: tile {tile:?} holds {actual:?}; its longest has {longest} pixels",
                run.name
            );
            let least = texel(held, tile)[2];
            assert!(
                (least - shortest).abs() <= ROUNDING * shortest,
                "{}: tile {tile:?} says {least} is shortest; it is {shortest}",
                run.name
            );
        }
    }
}

#[test]
fn neighbourhoods_hold_the_longest_of_the_tiles_that_count() {
    let (mut left_out, mut all) = (0, 0);
    for run in RUNS.iter() {
        let tiles = tiles(run);
        let rule = run.settings.values.get("neighbor_rule");
        let rule = rule.map_or("all".to_owned(), Value::to_string);
        for tile in tiles.all() {
            let actual = vector(run.texture("neighborhoods"), tile);
            let around: Vec<([i64; 2], Vec2)> = tiles.around(tile).collect();
            let counting: Vec<Vec2> = (around.iter())
                .filter(|(offset, vector)| tiles::counts(&rule, *offset, *vector))
                .map(|(_, vector)| *vector)
                .collect();
            let longest = counting.iter().copied().map(length).fold(0.0, f64::max);
            assert!(
                (counting.contains(&actual) || longest == 0.0)
                    && length(actual) >= longest * (1.0 - ROUNDING),
                "{}: tile {tile:?} holds {actual:?}; the longest that counts has {longest} pixels",
                run.name
            );
            let lengths = around.iter().map(|(_, vector)| length(*vector));
            let of_all = lengths.fold(0.0, f64::max);
            left_out += usize::from(longest < of_all * (1.0 - ROUNDING));
            all += usize::from(rule != "all");
        }
    }
    // The rule about diagonal tiles decides in at least one of forty.
    assert!(40 * left_out > all, "{left_out} of {all}");
}

#[test]
fn tile_variance_follows_the_directions_of_neighbouring_tiles() {
    let (mut varied, mut all) = (0, 0);
    for run in RUNS.iter().filter(|run| run.filter == "guertin") {
        let tiles = tiles(run);
        for tile in tiles.all() {
            let expected = tiles.variance(tile);
            let actual = texel(run.texture("neighborhoods"), tile)[2];
            // A mean of nine cosines, each of two quotients.
            assert!(
                (actual - expected).abs() < 1e-5,
                "{}: tile {tile:?} varies by {actual}; the reference says {expected}",
                run.name
            );
            varied += usize::from(expected > 0.1);
            all += 1;
        }
    }
    assert!(2 * varied > all, "only {varied} of {all} vary");
}

#[test]
fn mcguire_s_reconstruction_equals_the_paper() {
    expect_pictures("mcguire", mcguire::reconstruct);
}

#[test]
fn guertin_s_reconstruction_equals_the_paper() {
    expect_pictures("guertin", guertin::reconstruct);
}

fn expect_pictures(filter: &str, reference: Reference) {
    let (mut unblurred, mut blurred, mut all) = (0, 0, 0);
    for run in RUNS.iter().filter(|run| run.filter == filter) {
        let mut compared = 0;
        for pixel in run.pixels() {
            let Some((expected, error)) = reference(run, pixel) else {
                continue;
            };
            // Colours are in [0, 2). A weight is off by 1e-4 at most, where a depth of 20 m in
            // 32-bit floats is divided by an extent of 0.1 m.
            run.assert_color(pixel, expected, 1e-3 + error);
            compared += 1;
            if expected == color(run, pixel) {
                unblurred += 1
            } else {
                blurred += 1
            }
        }
        // Up to 35 taps, each with a chance of 2 x 1.5e-3 per axis to be undecided. A sixth of the
        // pixels may be as near to one border of a small tile as to another.
        let count = run.output.pixels.len();
        let name = &run.name;
        assert!(2 * compared > count, "{name}: {compared} of {count}");
        all += count;
    }
    // Both ends of the filter are taken often.
    assert!(2 * blurred > all, "only {blurred} of {all} blurred");
    assert!(20 * unblurred > all, "only {unblurred} of {all} left alone");
}
