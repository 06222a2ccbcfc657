//! Worst place of a picture, and a crop around it.

use std::path::{Path, PathBuf};

use frame::{FileError, Image, Plane, Raster, Tile, display_srgb, tile_pictures, write_png};
use measure::magma;
use metrics::{Metric, Regions};
use serde::{Deserialize, Serialize};

/// Place of the largest error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Column of the middle of the worst block.
    pub x: u32,
    /// Row of the middle.
    pub y: u32,
    /// Searched error map, as named in errors.exr.
    pub map: String,
    /// Truth, output and error around it, side by side; relative to `run.json`.
    pub picture: PathBuf,
}

/// Side of the compared blocks, in pixels: larger than the noise of pixels, smaller than most
/// movers.
pub const BLOCK: u32 = 16;
/// Side of the crop around the worst block, in pixels.
pub const CROP: u32 = 64;
/// Side of an enlarged pixel of a crop.
const ENLARGED: u32 = 4;
/// Gap between the panels, in shown pixels.
const GAP: u32 = 8;

/// Returns the middle of the block with the largest sum over the metric's region; the first of
/// equal ones.
pub fn worst_block(metric: Metric, map: &Plane, regions: &Regions) -> (u32, u32) {
    let mask = regions.mask(metric.region());
    let inside = |x: u32, y: u32| mask.is_none_or(|mask| *mask.at(x, y));
    let columns = map.width.div_ceil(BLOCK);
    let rows = map.height.div_ceil(BLOCK);
    let mut sums = Raster::filled(columns, rows, 0.0);
    for y in 0..map.height {
        for x in (0..map.width).filter(|x| inside(*x, y)) {
            let block = (y / BLOCK) * columns + x / BLOCK;
            sums.pixels[block as usize] += f64::from(*map.at(x, y));
        }
    }
    let mut worst = 0;
    for (block, sum) in sums.pixels.iter().enumerate() {
        if *sum > sums.pixels[worst] {
            worst = block;
        }
    }
    let middle = |block: u32, size: u32| (block * BLOCK + BLOCK / 2).min(size - 1);
    let worst = worst as u32;
    (
        middle(worst % columns, map.width),
        middle(worst / columns, map.height),
    )
}

/// Writes truth, output and error around a place, enlarged, from left to right; the error's
/// brightness is relative to the largest in the crop.
pub fn write_crop(
    path: &Path,
    (x, y): (u32, u32),
    [truth, output]: [&Image; 2],
    map: &Plane,
    stops: f32,
) -> Result<(), FileError> {
    let tile = Tile::around([x, y], CROP, map.size());
    let error = map.part(tile);
    let largest = error
        .pixels
        .iter()
        .copied()
        .fold(f32::MIN_POSITIVE, f32::max);
    let panels = [
        display_srgb(&truth.part(tile), stops),
        display_srgb(&output.part(tile), stops),
        magma(&error.map(|error| error / largest)),
    ];
    let panels = panels.map(|panel| panel.enlarged(ENLARGED));
    write_png(path, &tile_pictures(&panels, 3, GAP, [0.5; 3]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_block_is_that_of_the_largest_sum_inside_the_region() {
        let moving = Raster::from_fn(40, 40, |x, _| x < 32);
        let regions = Regions {
            still: moving.map(|moves| !moves),
            knowable: moving.clone(),
            unknowable: moving.map(|_| false),
            support: Raster::from_fn(40, 40, |x, _| x < 16),
            moving,
        };
        // A faint error over all of one block, one bright pixel in another, and the brightest in
        // the last.
        let map = Raster::from_fn(40, 40, |x, y| match (x, y) {
            (3, 3) => 0.9,
            (39, 39) => 9.0,
            (16..32, 16..32) => 0.01,
            _ => 0.0,
        });
        let place = |name: &str| worst_block(name.parse().unwrap(), &map, &regions);
        assert_eq!(place("flip_moving"), (24, 24));
        assert_eq!(place("flip_support"), (8, 8));
        assert_eq!(place("label_tv"), (24, 24));
        assert_eq!(place("flip_static"), (39, 39));
        assert_eq!(place("flip_full"), (39, 39));
    }
}
