//! Maps of an audit: the result of each pixel.

use std::path::Path;

use frame::{FileError, Raster, write_png};

/// Shift from which on a colour is full, in pixels.
const FULL: f64 = 1.0;
/// Smallest shift that is shown as an error, in pixels.
const SHOWN: f64 = 0.25;
/// Smallest width of a picture.
const MIN_WIDTH: u32 = 480;

/// Result of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapPixel {
    /// Nothing: an edge, outside the picture or hidden in the frame before.
    Excluded,
    /// Nothing: no detail.
    Even,
    /// Nothing: no shift makes both pictures alike.
    Unlike,
    /// Velocity leads behind its surface.
    Behind,
    /// Velocity is wrong by this vector.
    Shift([f64; 2]),
}

/// Writes a map: grey is excluded, dark grey has no detail, white is not alike; green carries, and
/// where velocity is wrong the error's direction is the hue, and red is to the right.
pub fn write_map(path: &Path, map: &Raster<MapPixel>) -> Result<(), FileError> {
    let factor = MIN_WIDTH.div_ceil(map.width).max(1);
    write_png(path, &map.map(color_of).enlarged(factor))
}

fn color_of(pixel: &MapPixel) -> [f32; 3] {
    match *pixel {
        MapPixel::Excluded => [0.5; 3],
        MapPixel::Even => [0.2; 3],
        MapPixel::Unlike => [1.0; 3],
        MapPixel::Behind => [0.0; 3],
        MapPixel::Shift([x, y]) if x.hypot(y) <= SHOWN => [0.1, 0.5, 0.1],
        MapPixel::Shift(shift) => show_error(shift),
    }
}

/// Shows direction as hue, without green: red right, yellow down, blue left, violet up.
fn show_error([x, y]: [f64; 2]) -> [f32; 3] {
    let full = (x.hypot(y) / FULL).min(1.0);
    let strength = (0.5 + 0.5 * full) as f32;
    let turn = y.atan2(x).rem_euclid(std::f64::consts::TAU) / std::f64::consts::FRAC_PI_2;
    let corners = [
        [1.0, 0.1, 0.1],
        [1.0, 0.9, 0.0],
        [0.1, 0.3, 1.0],
        [0.8, 0.1, 0.9],
    ];
    let first = turn.floor() as usize % 4;
    let part = turn.fract() as f32;
    std::array::from_fn(|channel| {
        let [one, other] = [corners[first], corners[(first + 1) % 4]].map(|color| color[channel]);
        strength * (one + part * (other - one))
    })
}
