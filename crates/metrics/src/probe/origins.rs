//! Origins of the light in each pixel.

use frame::{AtInstant, Raster};

use super::pictures::Probes;
use crate::math::raster::index_pixels;

/// Origin of a pixel's light: offset from the pixel's centre, and standard deviation about it, in
/// pixels.
#[derive(Clone, Copy)]
pub struct Origin {
    /// Offset in pixels, +x right, +y down.
    pub offset: [f64; 2],
    /// Standard deviation in pixels.
    pub spread: f64,
}

/// Variance of a point within a pixel, both axes together.
const WITHIN_A_PIXEL: f64 = 2.0 / 12.0;

/// Origins in a truth, in its 32 bits: offset, and its squares xx and yy.
pub struct TrueOrigins(Raster<Option<[f32; 4]>>);

impl TrueOrigins {
    /// Finds the origins; none for a pixel if a part of it has no place at the instant.
    pub fn new(seen: &AtInstant) -> Self {
        Self(index_pixels(&seen.placed, |at| {
            let ([x, y], [xx, yy]) = (seen.offset.pixels[at], seen.spread.pixels[at]);
            // A mean of ones is one except for rounding.
            (f64::from(seen.placed.pixels[at]) > 1.0 - 1e-6).then_some([x, y, xx, yy])
        }))
    }

    /// Returns the origin of the pixel with this index.
    pub fn at(&self, index: usize) -> Option<Origin> {
        let [x, y, xx, yy] = self.0.pixels[index]?.map(f64::from);
        Some(Origin {
            offset: [x, y],
            spread: (xx + yy - squared_length([x, y])).max(0.0).sqrt(),
        })
    }
}

/// Finds the origin that a filter gathers the pixel with this index from; `None` if it gathers
/// nothing.
pub fn find_gathered_origin(probes: &Probes, index: usize) -> Option<Origin> {
    let (width, height) = (probes.weight.width, probes.weight.height);
    let weight = f64::from(probes.weight.pixels[index]);
    if weight <= 0.0 {
        return None;
    }
    let middle = probes.first.pixels[index].map(|sum| f64::from(sum) / weight);
    let (x, y) = (index % width as usize, index / width as usize);
    let here = [
        x as f64 + 0.5 - 0.5 * f64::from(width),
        y as f64 + 0.5 - 0.5 * f64::from(height),
    ];
    let second = probes.second.pixels[index];
    let square = (f64::from(second[0]) + f64::from(second[2])) / weight;
    // Gathered pixels have a width of their own.
    let variance = (square - squared_length(middle)).max(0.0) + WITHIN_A_PIXEL;
    Some(Origin {
        offset: [middle[0] - here[0], middle[1] - here[1]],
        spread: variance.sqrt(),
    })
}

fn squared_length(v: [f64; 2]) -> f64 {
    v[0] * v[0] + v[1] * v[1]
}
