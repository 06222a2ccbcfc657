//! Origins of the light in each pixel.

use frame::{AtInstant, Raster};

use super::pictures::Probes;

/// Origin of a pixel's light: offset from the pixel's centre, and standard deviation about it, in pixels.
#[derive(Clone, Copy)]
pub struct Origin {
    /// Offset in pixels, +x right, +y down.
    pub offset: [f64; 2],
    /// Standard deviation in pixels.
    pub spread: f64,
}

/// Variance of a point within a pixel, both axes together.
const WITHIN_A_PIXEL: f64 = 2.0 / 12.0;

/// Finds the origins in the truth; `None` for a pixel part of which has no place at the instant.
pub fn find_true_origins(seen: &AtInstant) -> Raster<Option<Origin>> {
    let whole = seen.offset.zip(&seen.spread, |offset, spread| {
        let offset = offset.map(f64::from);
        let square = f64::from(spread[0]) + f64::from(spread[2]);
        Origin {
            offset,
            spread: (square - squared_length(offset)).max(0.0).sqrt(),
        }
    });
    whole.zip(&seen.placed, |origin, placed| {
        // A mean of ones is one but for rounding.
        (f64::from(*placed) > 1.0 - 1e-6).then_some(*origin)
    })
}

/// Finds the origins that a filter gathers from; `None` for a pixel that gathers nothing.
pub fn find_gathered_origins(probes: &Probes) -> Raster<Option<Origin>> {
    let (width, height) = (probes.weight.width, probes.weight.height);
    Raster::from_fn(width, height, |x, y| {
        let weight = f64::from(*probes.weight.at(x, y));
        if weight <= 0.0 {
            return None;
        }
        let middle = probes.first.at(x, y).map(|sum| f64::from(sum) / weight);
        let here = [
            f64::from(x) + 0.5 - 0.5 * f64::from(width),
            f64::from(y) + 0.5 - 0.5 * f64::from(height),
        ];
        let second = probes.second.at(x, y);
        let square = (f64::from(second[0]) + f64::from(second[2])) / weight;
        // Gathered pixels have a width of their own.
        let variance = (square - squared_length(middle)).max(0.0) + WITHIN_A_PIXEL;
        Some(Origin {
            offset: [middle[0] - here[0], middle[1] - here[1]],
            spread: variance.sqrt(),
        })
    })
}

fn squared_length(v: [f64; 2]) -> f64 {
    v[0] * v[0] + v[1] * v[1]
}
