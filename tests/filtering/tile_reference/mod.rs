//! Tile filters on the GPU against their papers in 64-bit floats. Each pass gets the output of the pass before.

mod guertin;
mod mcguire;
mod noise;
mod published;
mod tiles;

use filters::{Blur, Filter, Settings, Value};
use frame::{Image, Raster};
use tests::open_gpu;
use tiles::{Tiles, Vec2, length};

use crate::fields::{self, Field, rectangles};

/// Makes fields of odd sizes, wide and tall, none a multiple of a tile; two of random pixels, two of objects over a
/// slow background.
fn fields() -> Vec<(&'static str, Field)> {
    vec![
        ("noise 61x37", fields::noise(61, 37, 1)),
        ("noise 31x71", fields::noise(31, 71, 2)),
        ("rectangles 97x53", rectangles(97, 53, 3)),
        ("rectangles 61x67", rectangles(61, 67, 4)),
    ]
}

/// A filter, changes to its preset `paper`, and the exposure in frames. At 1, most motion is cut at the side of a tile;
/// at 0.3, little is; at 0.05, most of it is less than half a pixel.
type Case = (&'static str, &'static [(&'static str, &'static str)], f64);

const CASES: [Case; 9] = [
    ("mcguire", &[], 1.0),
    ("mcguire", &[("tile_size", "7"), ("samples", "9")], 0.3),
    ("mcguire", &[("jitter", "none"), ("samples", "8")], 0.5),
    (
        "mcguire",
        &[("tile_size", "90"), ("soft_extent", "3")],
        0.05,
    ),
    ("guertin", &[], 1.0),
    ("guertin", &[("tile_size", "7"), ("samples", "9")], 0.3),
    (
        "guertin",
        &[
            ("tile_size", "12"),
            ("neighbor_rule", "all"),
            ("jitter", "0"),
        ],
        0.5,
    ),
    (
        "guertin",
        &[
            ("tile_size", "16"),
            ("neighbor_rule", "either_way"),
            ("split", "alternate"),
        ],
        0.7,
    ),
    ("guertin", &[("tile_size", "90"), ("tile_blend", "0")], 0.05),
];

const FRAME_INDEX: u32 = 11;

/// Value of a pixel by a reference, where rounding does not decide.
struct Expected {
    color: [f64; 3],
    /// Error that 32-bit noise may cause.
    tolerance: f64,
}

/// A case on a field, with the output of its passes.
struct Run {
    name: String,
    settings: Settings,
    exposure: f64,
    field: Field,
    motion: Raster<[f32; 4]>,
    tiles: Raster<[f32; 4]>,
    neighborhoods: Raster<[f32; 4]>,
    output: Image,
}

fn runs(filter: &str) -> Vec<Run> {
    let gpu = open_gpu();
    let mut runs = Vec::new();
    for (name, changes, exposure) in CASES.iter().filter(|(name, ..)| *name == filter) {
        let filter = Filter::builtin(name).unwrap();
        for (field_name, field) in fields() {
            let mut settings = filter.settings(Some("paper")).unwrap();
            for (parameter, value) in *changes {
                settings.set(&filter, parameter, value).unwrap();
            }
            let (width, height) = (field.color.width, field.color.height);
            let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
            let output = field.blur(&mut blur, *exposure, FRAME_INDEX);
            runs.push(Run {
                name: format!("{name} {changes:?} at {exposure} on {field_name}"),
                motion: blur.read_texture("motion").unwrap(),
                tiles: blur.read_texture("tiles").unwrap(),
                neighborhoods: blur.read_texture("neighborhoods").unwrap(),
                output,
                settings,
                exposure: *exposure,
                field,
            });
        }
    }
    runs
}

fn every_run() -> Vec<Run> {
    ["mcguire", "guertin"].into_iter().flat_map(runs).collect()
}

impl Run {
    fn integer(&self, name: &str) -> i64 {
        match self.settings.values[name] {
            Value::Integer(value) => value.into(),
            _ => panic!("{name} is an integer"),
        }
    }

    fn real(&self, name: &str) -> f64 {
        match self.settings.values[name] {
            Value::Real(value) => value,
            _ => panic!("{name} is a real number"),
        }
    }

    fn choice(&self, name: &str) -> String {
        self.settings.values[name].to_string()
    }

    fn size(&self) -> [i64; 2] {
        [self.output.width.into(), self.output.height.into()]
    }

    fn pixels(&self) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [width, height] = self.size();
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    /// Returns the half-velocity that the first pass wrote, in pixels.
    fn motion(&self, pixel: [i64; 2]) -> Vec2 {
        vector(&self.motion, pixel)
    }

    fn depth(&self, [x, y]: [i64; 2]) -> f64 {
        (*self.field.depth.at(x as u32, y as u32)).into()
    }

    fn color(&self, [x, y]: [i64; 2]) -> [f64; 3] {
        self.field.color.at(x as u32, y as u32).map(f64::from)
    }

    fn tiles(&self) -> Tiles<'_> {
        Tiles {
            side: self.integer("tile_size"),
            image: self.size(),
            vectors: &self.tiles,
        }
    }

    /// Compares the picture with a reference. Returns how many pixels the reference decides, and how many of those it
    /// blurs.
    fn compare(&self, reference: impl Fn(&Run, [i64; 2]) -> Option<Expected>) -> (usize, usize) {
        let (mut compared, mut blurred) = (0, 0);
        for (pixel, found) in self.pixels().zip(&self.output.pixels) {
            let Some(Expected { color, tolerance }) = reference(self, pixel) else {
                continue;
            };
            // Colours lie in [0, 2). A weight is off by 1e-4 at most, where a depth of 20 m in 32-bit floats is divided
            // by an extent of 0.1 m.
            let tolerance = 1e-3 + tolerance;
            for (expected, found) in color.iter().zip(found) {
                assert!(
                    (expected - f64::from(*found)).abs() < tolerance,
                    "{}: pixel {pixel:?} is {found}; the reference says {expected} +- {tolerance}",
                    self.name
                );
            }
            compared += 1;
            blurred += usize::from(color != self.color(pixel));
        }
        (compared, blurred)
    }
}

fn vector(raster: &Raster<[f32; 4]>, [x, y]: [i64; 2]) -> Vec2 {
    let [horizontal, vertical, ..] = *raster.at(x as u32, y as u32);
    [horizontal.into(), vertical.into()]
}

/// 16 rounding steps of a 32-bit float: a length is a sum of two squares and a root.
const ROUNDING: f64 = 16.0 * 6e-8;

#[test]
fn half_velocities_equal_the_papers() {
    let (mut still, mut slow, mut free, mut cut) = (0, 0, 0, 0);
    for run in every_run() {
        for pixel in run.pixels() {
            let full = run.field.velocity.at(pixel[0] as u32, pixel[1] as u32);
            let half = full.map(|component| 0.5 * run.exposure * f64::from(component));
            let longest = run.integer("tile_size") as f64;
            let expected = tiles::half_velocity(half, longest);
            let found = run.motion(pixel);
            for axis in 0..2 {
                assert!(
                    (found[axis] - expected[axis]).abs() <= ROUNDING * length(expected),
                    "{}: pixel {pixel:?} is {found:?}; the reference says {expected:?}",
                    run.name
                );
            }
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
    for run in every_run() {
        let tiles = run.tiles();
        assert_eq!(
            [run.tiles.width, run.tiles.height].map(i64::from),
            tiles.count(),
            "{}",
            run.name
        );
        for tile in tiles.all() {
            let motion: Vec<Vec2> = tiles.pixels(tile).map(|pixel| run.motion(pixel)).collect();
            let lengths = motion.iter().copied().map(length);
            let (shortest, longest) = lengths
                .fold((f64::INFINITY, 0.0f64), |(low, high), speed| {
                    (low.min(speed), high.max(speed))
                });
            let found = vector(&run.tiles, tile);
            // Motion that is cut has one length, so a correct run may choose any of the longest.
            assert!(
                motion.contains(&found) && length(found) >= longest * (1.0 - ROUNDING),
                "{}: tile {tile:?} holds {found:?}; its longest has {longest} pixels",
                run.name
            );
            let least = f64::from(run.tiles.at(tile[0] as u32, tile[1] as u32)[2]);
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
    for run in every_run() {
        let tiles = run.tiles();
        let rule = run.settings.values.get("neighbor_rule");
        let rule = rule.map_or("all".to_owned(), Value::to_string);
        for tile in tiles.all() {
            let found = vector(&run.neighborhoods, tile);
            let around: Vec<([i64; 2], Vec2)> = tiles.around(tile).collect();
            let counting: Vec<Vec2> = around
                .iter()
                .filter(|(offset, vector)| tiles::counts(&rule, *offset, *vector))
                .map(|(_, vector)| *vector)
                .collect();
            let longest = counting.iter().copied().map(length).fold(0.0, f64::max);
            assert!(
                (counting.contains(&found) || longest == 0.0)
                    && length(found) >= longest * (1.0 - ROUNDING),
                "{}: tile {tile:?} holds {found:?}; the longest that counts has {longest} pixels",
                run.name
            );
            let of_all = around
                .iter()
                .map(|(_, vector)| length(*vector))
                .fold(0.0, f64::max);
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
    for run in runs("guertin") {
        let tiles = run.tiles();
        for tile in tiles.all() {
            let expected = tiles.variance(tile);
            let found = f64::from(run.neighborhoods.at(tile[0] as u32, tile[1] as u32)[2]);
            // A mean of nine cosines, each of two quotients.
            assert!(
                (found - expected).abs() < 1e-5,
                "{}: tile {tile:?} varies by {found}; the reference says {expected}",
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

fn expect_pictures(filter: &str, reference: fn(&Run, [i64; 2]) -> Option<Expected>) {
    let (mut unblurred, mut blurred, mut all) = (0, 0, 0);
    for run in runs(filter) {
        let count = run.output.pixels.len();
        let (compared, of_those) = run.compare(reference);
        // Up to 35 taps, each with a chance of 2 x 1.5e-3 per axis to be undecided. A sixth of the pixels may lie as
        // near to one border of a small tile as to another.
        assert!(
            2 * compared > count,
            "{}: only {compared} of {count} compared",
            run.name
        );
        blurred += of_those;
        unblurred += compared - of_those;
        all += count;
    }
    // Both ends of the filter are taken often.
    assert!(2 * blurred > all, "only {blurred} of {all} blurred");
    assert!(20 * unblurred > all, "only {unblurred} of {all} left alone");
}
