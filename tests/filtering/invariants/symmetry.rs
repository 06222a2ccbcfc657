//! Mirrored frames.

use filters::{Filter, Settings};
use frame::{Raster, Reprojection};
use tests::presets::{every_preset, preset_name};
use tests::random::Random;
use tests::ready_blur;

use super::{FRAME_INDEX, random};
use crate::fields::Field;

fn mirror(field: &Field, horizontal: bool) -> Field {
    fn turn<T: Copy>(raster: &Raster<T>, horizontal: bool) -> Raster<T> {
        Raster::from_fn(raster.width, raster.height, |x, y| {
            if horizontal {
                *raster.at(raster.width - 1 - x, y)
            } else {
                *raster.at(x, raster.height - 1 - y)
            }
        })
    }
    let velocity = turn(&field.velocity, horizontal);
    Field {
        color: turn(&field.color, horizontal),
        velocity: velocity.map(|[x, y]| if horizontal { [-x, *y] } else { [*x, -y] }),
        depth: turn(&field.depth, horizontal),
        reprojection: mirror_camera(field, usize::from(!horizontal)),
        exposure: field.exposure,
    }
}

/// Mirrors the reprojection: x = side - x' on both sides, along one axis.
fn mirror_camera(field: &Field, axis: usize) -> Option<Reprojection> {
    let side = f64::from([field.color.width, field.color.height][axis]);
    let mut rows = field.reprojection?.rows.map(|mut row| {
        row[2] += side * row[axis];
        row[axis] = -row[axis];
        row
    });
    rows[axis] = [0, 1, 2, 3].map(|column| side * rows[2][column] - rows[axis][column]);
    Some(Reprojection { rows })
}

/// Counts pixels that differ by more than 1e-3 of the brightest tap. That is many times the
/// rounding of positions (1e-5 pixels) times the contrast of neighbours, and far below the weight
/// of one tap of twenty.
fn asymmetric_pixels(field: &Field, filter: &Filter, settings: &Settings) -> usize {
    let size = (field.color.width, field.color.height);
    let mut blur = ready_blur(filter, settings, size);
    let output = field.blur(&mut blur, FRAME_INDEX);
    let count = [true, false].map(|horizontal| {
        let turned = mirror(field, horizontal);
        let color = turned.blur(&mut blur, FRAME_INDEX);
        let back = mirror(&Field { color, ..turned }, horizontal);
        let pairs = output.pixels.iter().zip(&back.color.pixels);
        pairs
            .filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3))
            .count()
    });
    count.iter().sum()
}

/// Makes colours up to 1 and depths that are all different, so that only the geometry decides.
fn distinct_depths(seed: u64) -> Field {
    let mut field = random(seed);
    let mut random = Random::new(seed);
    field.color = field.color.map(|pixel| pixel.map(|value| value.min(1.0)));
    field.depth = field.depth.map(|_| random.real(0.2, 40.0));
    field
}

#[test]
fn a_mirrored_frame_gives_the_mirrored_output() {
    let field = distinct_depths(9);
    let mut tried = 0;
    for (filter, settings) in every_preset() {
        if filter.mirror_symmetric {
            let count = asymmetric_pixels(&field, &filter, &settings);
            assert_eq!(count, 0, "{}", preset_name(&filter, &settings));
            tried += 1;
        }
    }
    // Identity and three presets of velocity_gather declare themselves symmetric.
    assert!(tried >= 4, "only {tried}");
}

#[test]
fn the_jump_flood_is_symmetric_except_for_noise_equal_depths_and_rounding() {
    let filter = Filter::builtin("jump_flood").unwrap();
    for preset in &filter.presets {
        let mut settings = filter.settings(Some(&preset.name)).unwrap();
        settings.set(&filter, "jitter", "none").unwrap();
        // Between texels of random depth, rounding of a position moves replaced taps by tenths of a
        // pixel.
        if settings.values["tap"].to_string() == "replaced" {
            settings.set(&filter, "fetch", "nearest").unwrap();
        }
        // 16 bits round positions towards the top left.
        settings.set(&filter, "map", "float32").unwrap();
        let count = asymmetric_pixels(&distinct_depths(10), &filter, &settings);
        // At most 6 of 2 x 3053 pixels may differ: a tap on the edge of a texel, or a decision
        // within rounding of its threshold, may go either way.
        assert!(count <= 6, "preset {}: {count} pixels differ", preset.name);
    }
}
