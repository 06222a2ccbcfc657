//! One-frame oracle: about the best picture that one frame with straight motion can give, far too slow for a filter.

use frame::{Efficiency, Frame, Picture, Raster, Shutter, ShutterProfile, Truth};
use rayon::prelude::*;

/// Least number of instants.
const MIN_INSTANTS: u32 = 64;
/// Instants per pixel that the fastest pixel moves.
const INSTANTS_PER_PIXEL: f64 = 4.0;
/// Upper limit on the instants.
const MAX_INSTANTS: u32 = 1024;
/// Instants whose pictures are in memory together.
const TOGETHER: usize = 16;

/// Moves every pixel of the frame along its velocity for many instants of the shutter, lets the nearer hide the farther,
/// fills each hole with the farthest of the pixels that are nearest to it in the four directions, and averages. The picture is as large as
/// the frame, guard band included.
pub fn scatter_oracle(frame: &Frame, shutter: Shutter, profile: &ShutterProfile) -> Picture {
    let height = frame.color.height - 2 * frame.guard_band;
    let row_delay = |row: u32| {
        let row = row.saturating_sub(frame.guard_band).min(height - 1);
        profile.row_offset(row, height)
    };
    let mut color = frame.color.map(|_| [0.0_f64; 3]);
    let mut coverage: Vec<Raster<f64>> = (frame.coverage.iter())
        .map(|plane| plane.map(|_| 0.0))
        .collect();
    for together in place_instants(frame, shutter, &profile.efficiency).chunks(TOGETHER) {
        let seen = together
            .par_iter()
            .map(|(time, _)| fill_holes(frame, scatter(frame, *time, row_delay)));
        for ((_, weight), seen) in together.iter().zip(seen.collect::<Vec<_>>()) {
            for (sum, &source) in color.pixels.iter_mut().zip(&seen) {
                let color = frame.color.pixels[source as usize];
                *sum = [0, 1, 2].map(|c| sum[c] + weight * f64::from(color[c]));
            }
            for (sums, plane) in coverage.iter_mut().zip(&frame.coverage) {
                for (sum, &source) in sums.pixels.iter_mut().zip(&seen) {
                    *sum += weight * f64::from(plane.pixels[source as usize]);
                }
            }
        }
    }
    Picture {
        color: color.map(|sum| sum.map(|component| component as f32)),
        coverage: (coverage.iter())
            .map(|plane| plane.map(|sum| *sum as f32))
            .collect(),
    }
}

/// Makes the oracle's picture through the shutter of a truth, without the frame's guard band.
pub fn make_oracle(frame: &Frame, truth: &Truth) -> Picture {
    scatter_oracle(frame, truth.shutter, &truth.shutter_profile).cropped(frame.guard_band)
}

/// Lists times of the shutter, each with its share of the light.
fn place_instants(frame: &Frame, shutter: Shutter, efficiency: &Efficiency) -> Vec<(f64, f64)> {
    let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    let distance = f64::from(speeds.fold(0.0, f32::max)) * shutter.exposure();
    let wanted = (INSTANTS_PER_PIXEL * distance).ceil() as u32;
    let count = wanted.clamp(MIN_INSTANTS, MAX_INSTANTS);
    let knots = efficiency.knots();
    let middles = (0..count).map(|index| (f64::from(index) + 0.5) / f64::from(count));
    let total: f64 = middles.clone().map(|part| light_at(&knots, part)).sum();
    middles
        .map(|part| (shutter.at(part), light_at(&knots, part) / total))
        .collect()
}

/// Interpolates how much light passes at a part of the interval.
fn light_at(knots: &[[f64; 2]], part: f64) -> f64 {
    let next = knots.partition_point(|[at, _]| *at <= part);
    let [from, to] = [knots[next - 1], knots[next.min(knots.len() - 1)]];
    let length = to[0] - from[0];
    if length > 0.0 {
        from[1] + (part - from[0]) / length * (to[1] - from[1])
    } else {
        to[1]
    }
}

/// A place that no pixel reached.
const HOLE: u32 = u32::MAX;

/// Finds, per pixel, which pixel of the frame is there at a time: the nearest to the camera.
fn scatter(frame: &Frame, time: f64, row_delay: impl Fn(u32) -> f64) -> Vec<u32> {
    let (width, height) = frame.size();
    let mut seen = vec![HOLE; frame.color.pixels.len()];
    for row in 0..height {
        let time = (time + row_delay(row)) as f32;
        for column in 0..width {
            let source = row * width + column;
            let [right, down] = frame.velocity.pixels[source as usize];
            let x = (column as f32 + 0.5 + right * time).floor();
            let y = (row as f32 + 0.5 + down * time).floor();
            if x < 0.0 || y < 0.0 || x >= width as f32 || y >= height as f32 {
                continue;
            }
            let place = &mut seen[(y as u32 * width + x as u32) as usize];
            let depth = |pixel: u32| frame.depth.pixels[pixel as usize];
            if *place == HOLE || depth(source) < depth(*place) {
                *place = source;
            }
        }
    }
    seen
}

/// Fills the places that no pixel reached.
fn fill_holes(frame: &Frame, mut seen: Vec<u32>) -> Vec<u32> {
    let [width, height] = [frame.color.width, frame.color.height].map(|side| side as usize);
    let mut fills: Vec<Option<Fill>> = vec![None; seen.len()];
    let rows = (0..height).map(|row| (row * width, width, 1));
    let columns = (0..width).map(|column| (column, height, width));
    for (first, count, step) in rows.chain(columns) {
        let along = || (0..count).map(|index| first + index * step);
        offer_fills(frame, &seen, along(), &mut fills);
        offer_fills(frame, &seen, along().rev(), &mut fills);
    }
    for (place, source) in seen.iter_mut().enumerate() {
        if *source == HOLE {
            // All of the frame may have left it.
            *source = fills[place].map_or(place as u32, |fill| fill.source);
        }
    }
    seen
}

/// A pixel that may fill a hole.
#[derive(Clone, Copy)]
struct Fill {
    source: u32,
    depth: f32,
    distance: u32,
}

/// Goes along a line of places and offers each hole the pixel that was met last: the farther wins, then the nearer in the picture.
fn offer_fills(
    frame: &Frame,
    seen: &[u32],
    line: impl Iterator<Item = usize>,
    fills: &mut [Option<Fill>],
) {
    let mut last: Option<Fill> = None;
    for place in line {
        if seen[place] != HOLE {
            last = Some(Fill {
                source: seen[place],
                depth: frame.depth.pixels[seen[place] as usize],
                distance: 0,
            });
            continue;
        }
        let Some(offered) = &mut last else { continue };
        offered.distance += 1;
        let better = fills[place].is_none_or(|fill| {
            offered.depth > fill.depth
                || (offered.depth == fill.depth && offered.distance < fill.distance)
        });
        if better {
            fills[place] = Some(*offered);
        }
    }
}
