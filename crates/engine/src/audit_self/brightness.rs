//! Brightness of a picture, smoothed, to compare with another picture between its pixels.

use frame::{Image, Plane, Raster};
use glam::DVec2;

/// Exponent that spreads brightness about as a display does.
const ENCODING: f32 = 1.0 / 2.2;
/// Largest brightness that is kept apart: highlights outshine all detail.
const MAX_BRIGHTNESS: f32 = 2.0;
/// Part of the pixels that are darker than white.
const BELOW_WHITE: f64 = 0.9;

/// Encoded brightness of a picture, smoothed over three pixels.
pub struct Brightness {
    plane: Plane,
}

/// Brightness and its slope per pixel at a place.
#[derive(Clone, Copy)]
pub struct Sample {
    pub value: f64,
    pub slope: DVec2,
}

impl Brightness {
    /// Encodes and smooths the brightness of a picture, relative to `white`.
    pub fn of(color: &Image, white: f32) -> Self {
        let encode =
            |pixel: &[f32; 3]| ((luminance(pixel) / white).powf(ENCODING)).min(MAX_BRIGHTNESS);
        Self {
            plane: smooth(&color.map(encode)),
        }
    }

    /// Interpolates with Catmull-Rom's splines; none closer to the border than one pixel.
    pub fn at(&self, place: DVec2) -> Option<Sample> {
        let corner = place.floor();
        let (width, height) = (self.plane.width, self.plane.height);
        let is_inside = corner.min_element() >= 1.0
            && corner.x + 2.0 < f64::from(width)
            && corner.y + 2.0 < f64::from(height);
        if !is_inside {
            return None;
        }
        let part = place - corner;
        let [columns, rows] = [weights(part.x), weights(part.y)];
        let [slopes_x, slopes_y] = [slopes(part.x), slopes(part.y)];
        let first = (corner.y as usize - 1) * width as usize + corner.x as usize - 1;
        let mut sample = Sample {
            value: 0.0,
            slope: DVec2::ZERO,
        };
        for row in 0..4 {
            let start = first + row * width as usize;
            let line = &self.plane.pixels[start..start + 4];
            let sum = |factors: &[f64; 4]| -> f64 {
                let products = line.iter().zip(factors);
                products.map(|(value, factor)| f64::from(*value) * factor).sum()
            };
            let value = sum(&columns);
            sample.value += rows[row] * value;
            sample.slope += DVec2::new(rows[row] * sum(&slopes_x), slopes_y[row] * value);
        }
        Some(sample)
    }
}

/// Chooses the radiance that counts as white in some pictures; above 0.
pub fn choose_white(pictures: [&Image; 2]) -> f32 {
    let all = pictures.iter().flat_map(|picture| &picture.pixels);
    let mut values: Vec<f32> = all.map(luminance).filter(|value| *value > 0.0).collect();
    values.sort_by(f32::total_cmp);
    let at = (values.len() as f64 * BELOW_WHITE) as usize;
    values.get(at).copied().unwrap_or(1.0)
}

fn luminance([red, green, blue]: &[f32; 3]) -> f32 {
    (0.2126 * red + 0.7152 * green + 0.0722 * blue).max(0.0)
}

/// Smooths with the weights 1, 2, 1 in both directions.
fn smooth(plane: &Plane) -> Plane {
    let wide = plane.widened(1);
    Raster::from_fn(plane.width, plane.height, |x, y| {
        let row = |y: u32| 0.25 * (wide.at(x, y) + 2.0 * wide.at(x + 1, y) + wide.at(x + 2, y));
        0.25 * (row(y) + 2.0 * row(y + 1) + row(y + 2))
    })
}

/// Weights of four values around a place between the second and the third.
fn weights(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t3 + t2 - 0.5 * t,
        1.5 * t3 - 2.5 * t2 + 1.0,
        -1.5 * t3 + 2.0 * t2 + 0.5 * t,
        0.5 * t3 - 0.5 * t2,
    ]
}

/// Derivatives of [`weights`].
fn slopes(t: f64) -> [f64; 4] {
    let t2 = t * t;
    [
        -1.5 * t2 + 2.0 * t - 0.5,
        4.5 * t2 - 5.0 * t,
        -4.5 * t2 + 4.0 * t + 0.5,
        1.5 * t2 - t,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_is_interpolated_exactly() {
        let ramp = Raster::from_fn(16, 12, |x, y| [(0.03 * x as f32 + 0.02 * y as f32).powf(2.2); 3]);
        let sample = Brightness::of(&ramp, 1.0).at(DVec2::new(6.3, 4.8)).unwrap();
        assert!((sample.value - 0.03 * 6.3 - 0.02 * 4.8).abs() < 1e-6, "{}", sample.value);
        assert!((sample.slope - DVec2::new(0.03, 0.02)).length() < 1e-6, "{}", sample.slope);
    }
}
