//! The pilot: a short render that shows where a picture is noisy, and so where samples are needed.

use frame::Raster;

use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::dilate::dilate_square;
use crate::film::render::{Estimate, Film};
use crate::film::sample_counts::SampleCounts;
use crate::progress::{Meter, Progress, Watch};

/// Samples per pixel of each of the pilot's two replicates.
pub(crate) const PILOT_SAMPLES: u32 = 2;
/// Replicates of a pilot: the least whose difference shows the noise.
pub(crate) const PILOT_REPLICATES: u32 = 2;
/// Side of the tiles that share a number of samples, pixels. Their pixels' noise is averaged, because that of one pixel is
/// hardly known.
const TILE: u32 = 4;
/// Weight of squared errors where nothing moves. Scores of motion blur are pooled over what moves.
const WEIGHT_OF_STILL: f64 = 0.25;
/// Cost of a sample without bounces, in bounces.
const COST_OF_A_MISS: f64 = 0.25;

/// What the pilot found in a tile, summed over its pixels.
#[derive(Clone, Copy, Default)]
struct TilePilot {
    pixels: f64,
    /// Variance of the mean of a replicate.
    variance: f64,
    bounces: f64,
    /// True if anything was seen that moves.
    moves: bool,
}

/// The tiles of a canvas. They begin at the picture's corner, so that a guard band does not shift them.
#[derive(Clone, Copy)]
struct Tiles {
    canvas: Canvas,
    /// Tiles of the band to the left of the picture and above it.
    offset: u32,
}

impl Tiles {
    fn new(canvas: Canvas) -> Self {
        Self {
            canvas,
            offset: canvas.guard_band.div_ceil(TILE),
        }
    }

    /// A raster with one value per tile.
    fn filled<T: Clone>(self, value: T) -> Raster<T> {
        let [width, height] = [self.canvas.columns(), self.canvas.rows()]
            .map(|side| (side + self.offset * TILE).div_ceil(TILE));
        Raster::filled(width, height, value)
    }

    /// The index of a pixel's tile in such a raster.
    fn index<T>(self, raster: &Raster<T>, pixel: u32) -> usize {
        let columns = self.canvas.columns();
        let shift = self.offset * TILE - self.canvas.guard_band;
        let [column, row] = [pixel % columns, pixel / columns].map(|index| (index + shift) / TILE);
        (row * raster.width + column) as usize
    }
}

/// Chooses the samples of every pixel of a film, with at most `mean` on the average over its picture.
///
/// The mean square error over the picture is least where the samples of a pixel are in proportion to its noise, over the root
/// of what a sample costs (Neyman 1934). The pilot's samples are its own and go into no picture, so the choice does not bias
/// any. Errors where something moves, or within `margin` pixels, count more; `moving` tells it per object id.
pub(crate) fn choose_samples(
    pilot: &Film,
    moving: &[bool],
    margin: u32,
    mean: u32,
    watch: Watch,
) -> Result<SampleCounts, TraceError> {
    let pixels = pilot.canvas.pixels();
    // The pilot is no progress of the picture, but a chance to cancel it.
    let total = pixels.len() as u64 * u64::from(mean);
    let start = |_: Progress| watch(Progress { done: 0, total });
    let meter = Meter::new(&start, total);
    let probes = pilot.render(&pixels, &meter, |replicates| {
        probe_pixel(replicates, moving)
    })?;
    let tiles = Tiles::new(pilot.canvas);
    let mut found = tiles.filled(TilePilot::default());
    for (&pixel, probe) in pixels.iter().zip(&probes) {
        let index = tiles.index(&found, pixel);
        let tile = &mut found.pixels[index];
        tile.pixels += 1.0;
        tile.variance += probe.variance;
        tile.bounces += probe.bounces;
        tile.moves |= probe.moves;
    }
    let near_motion = dilate_square(&found.map(|tile| tile.moves), margin.div_ceil(TILE));
    let demands = found.zip(&near_motion, |tile, near_motion| {
        let weight = if *near_motion { 1.0 } else { WEIGHT_OF_STILL };
        let cost = COST_OF_A_MISS + tile.bounces / tile.pixels;
        (weight * tile.variance / tile.pixels / cost).sqrt()
    });
    let demand: Vec<f64> = (pixels.iter())
        .map(|&pixel| demands.pixels[tiles.index(&demands, pixel)])
        .collect();
    Ok(SampleCounts::share(pilot.canvas, &demand, mean))
}

/// Summarises the replicates of one pixel.
fn probe_pixel(replicates: &[Vec<Estimate>], moving: &[bool]) -> TilePilot {
    let pictures = replicates[0].len() as f64;
    let pairs = replicates[0].iter().zip(&replicates[1]);
    let squares = pairs.map(|(a, b)| {
        let frozen = a.at_instant.frozen - b.at_instant.frozen;
        (a.radiance - b.radiance)
            .length_squared()
            .max(frozen.length_squared())
    });
    let all = replicates.iter().flatten();
    TilePilot {
        pixels: 1.0,
        variance: squares.sum::<f64>() / (2.0 * 3.0 * pictures),
        bounces: all.clone().map(|estimate| estimate.bounces).sum::<f64>()
            / (f64::from(PILOT_REPLICATES) * pictures),
        moves: all
            .flat_map(|estimate| estimate.seen.iter().zip(moving))
            .any(|(seen, moves)| *seen > 0 && *moves),
    }
}
