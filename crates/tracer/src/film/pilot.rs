//! The pilot: a short render that shows where a picture is noisy, and so where samples are needed.

use frame::Raster;

use crate::error::TraceError;
use crate::film::canvas::Canvas;
use crate::film::dilate::dilate_square;
use crate::film::means::Estimate;
use crate::film::render::Film;
use crate::film::sample_counts::SampleCounts;
use crate::progress::{Meter, Progress, Watch};

/// Samples per pixel of each of the pilot's two replicates.
pub(crate) const PILOT_SAMPLES: u32 = 2;
/// Replicates of a pilot: the fewest whose difference shows the noise.
pub(crate) const PILOT_REPLICATES: u32 = 2;
/// Side of the tiles that share a number of samples, pixels. Their pixels' noise is averaged,
/// because one pixel's is hardly known.
const TILE: u32 = 4;
/// Weight of squared errors where nothing moves. Scores of motion blur are pooled over moving
/// pixels.
const WEIGHT_OF_STILL: f64 = 0.2;
/// Radiance below which a display shows all as dark.
const DARK: f64 = 0.005;
/// Weight of the variance of coverage against that of three times the cube root of radiance. Scores
/// of labels see the edge of a mover that has the colour of its surroundings.
const WEIGHT_OF_COVERAGE: f64 = 0.25;
/// Cost of a sample without bounces, in bounces.
const COST_OF_A_MISS: f64 = 0.25;

/// Findings of the pilot in a tile, summed over its pixels.
#[derive(Clone, Copy, Default)]
struct TilePilot {
    pixels: f64,
    /// Variance of the mean of a replicate.
    variance: f64,
    /// Variance of the coverages of a replicate, summed over the objects.
    coverage_variance: f64,
    /// Radiance, the mean of the components.
    radiance: f64,
    bounces: f64,
    /// True if anything was seen that moves.
    moves: bool,
}

/// The column and the row of a pixel's tile. A pixel of the guard band has the nearest tile of the
/// picture.
fn find_tile(canvas: Canvas, pixel: u32) -> [u32; 2] {
    let [x, y] = canvas.corner(pixel).map(|at| at.max(0.0) as u32);
    [
        x.min(canvas.width - 1) / TILE,
        y.min(canvas.height - 1) / TILE,
    ]
}

/// Chooses the samples of every pixel of a film, with at most `mean` on the average over its
/// picture.
///
/// The mean square error over the picture is least if the samples of a pixel are in proportion to
/// its noise, over the root of a sample's cost (Neyman 1934). The pilot's samples are its own and
/// go into no picture, so the choice does not bias any. Errors where something moves, or within
/// `margin` pixels, count more; `moving` says so per object id.
pub(crate) fn choose_samples(
    pilot: &Film,
    moving: &[bool],
    margin: u32,
    mean: u32,
    watch: Watch,
) -> Result<SampleCounts, TraceError> {
    let inside = pilot.canvas.pixels().into_iter();
    let pixels: Vec<u32> = inside
        .filter(|&pixel| pilot.canvas.is_in_picture(pixel))
        .collect();
    // The pilot does not count as progress of the picture, but may be cancelled.
    let total = pixels.len() as u64 * u64::from(mean);
    let start = |_: Progress| watch(Progress { done: 0, total });
    let meter = Meter::new(&start, total);
    let probes = pilot.summarise(&pixels, &meter, |replicates| {
        probe_pixel(replicates, moving)
    })?;
    let [columns, rows] = [pilot.canvas.width, pilot.canvas.height].map(|side| side.div_ceil(TILE));
    let mut tiles = Raster::filled(columns, rows, TilePilot::default());
    for (&pixel, probe) in pixels.iter().zip(&probes) {
        let [column, row] = find_tile(pilot.canvas, pixel);
        let tile = &mut tiles.pixels[(row * columns + column) as usize];
        tile.pixels += 1.0;
        tile.variance += probe.variance;
        tile.coverage_variance += probe.coverage_variance;
        tile.radiance += probe.radiance;
        tile.bounces += probe.bounces;
        tile.moves |= probe.moves;
    }
    // Variance of three times the cube root of radiance, which is about as lightness is perceived.
    let variance = widen(&tiles.map(|tile| {
        let pixels = tile.pixels;
        let shown = tile.variance / (DARK + tile.radiance / pixels).powf(4.0 / 3.0);
        (shown + WEIGHT_OF_COVERAGE * tile.coverage_variance) / pixels
    }));
    let near_motion = dilate_square(&tiles.map(|tile| tile.moves), margin.div_ceil(TILE));
    let demands = Raster::from_fn(tiles.width, tiles.height, |x, y| {
        let tile = tiles.at(x, y);
        let weight = if *near_motion.at(x, y) {
            1.0
        } else {
            WEIGHT_OF_STILL
        };
        let cost = COST_OF_A_MISS + tile.bounces / tile.pixels;
        (weight * variance.at(x, y) / cost).sqrt()
    });
    let demand: Vec<f64> = (pilot.canvas.pixels().into_iter())
        .map(|pixel| find_tile(pilot.canvas, pixel))
        .map(|[column, row]| *demands.at(column, row))
        .collect();
    Ok(SampleCounts::share(pilot.canvas, &demand, mean))
}

/// Raises each tile to the mean of itself and its neighbours. So a tile in which the pilot met
/// nothing by chance gets its share if it is next to a noisy one, or in an evenly noisy region.
fn widen(variance: &Raster<f64>) -> Raster<f64> {
    let around = |at: u32, end: u32| at.saturating_sub(1)..(at + 2).min(end);
    Raster::from_fn(variance.width, variance.height, |x, y| {
        let rows = around(y, variance.height);
        let tiles = rows.flat_map(|y| around(x, variance.width).map(move |x| (x, y)));
        let values: Vec<f64> = tiles.map(|(x, y)| *variance.at(x, y)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        variance.at(x, y).max(mean)
    })
}

/// Summarises the replicates of one pixel.
fn probe_pixel(replicates: &[Vec<Estimate>], moving: &[bool]) -> TilePilot {
    let pictures = replicates[0].len() as f64;
    let pairs = replicates[0].iter().zip(&replicates[1]);
    let squares = (pairs.clone()).map(|(a, b)| (a.radiance - b.radiance).length_squared());
    let coverage = pairs.flat_map(|(a, b)| {
        let seen = a.seen.iter().zip(&b.seen);
        seen.map(|(a, b)| (a - b) / f64::from(PILOT_SAMPLES))
    });
    let all = replicates.iter().flatten();
    TilePilot {
        pixels: 1.0,
        variance: squares.sum::<f64>() / (2.0 * 3.0 * pictures),
        coverage_variance: coverage.map(|difference| difference.powi(2)).sum::<f64>()
            / (2.0 * pictures),
        radiance: all
            .clone()
            .map(|estimate| estimate.radiance.element_sum())
            .sum::<f64>()
            / (3.0 * f64::from(PILOT_REPLICATES) * pictures),
        bounces: all.clone().map(|estimate| estimate.bounces).sum::<f64>()
            / (f64::from(PILOT_REPLICATES) * pictures),
        moves: all
            .flat_map(|estimate| estimate.seen.iter().zip(moving))
            .any(|(seen, moves)| *seen > 0.0 && *moves),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn estimate(radiance: f64, seen: [u32; 2]) -> Vec<Estimate> {
        vec![Estimate {
            radiance: DVec3::splat(radiance),
            bounces: 0.0,
            seen: seen.map(f64::from).to_vec(),
            at_instant: None,
        }]
    }

    #[test]
    fn a_pixel_is_noisy_in_its_radiance_or_in_its_coverage() {
        let probe = |a, b| probe_pixel(&[a, b], &[false, false]);
        let still = probe(estimate(0.5, [2, 0]), estimate(0.5, [2, 0]));
        assert_eq!((still.variance, still.coverage_variance), (0.0, 0.0));
        // Half the square of the difference is the variance of one of two replicates.
        let lit = probe(estimate(0.5, [2, 0]), estimate(0.9, [2, 0]));
        assert!((lit.variance - 0.08).abs() < 1e-12, "{}", lit.variance);
        // The coverages of both objects go from 1 and 0 to 0.5 each.
        let edge = probe(estimate(0.5, [2, 0]), estimate(0.5, [1, 1]));
        assert_eq!((edge.variance, edge.coverage_variance), (0.0, 0.25));
    }
}
