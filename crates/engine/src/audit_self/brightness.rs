//! Smoothed brightness of a picture, also between its pixels.

use frame::{Image, Plane, Raster, luminance};
use glam::DVec2;

/// Exponent that spreads brightness about as a display does.
const ENCODING: f32 = 1.0 / 2.2;
/// Largest brightness that is kept apart: highlights outshine all detail.
const MAX_BRIGHTNESS: f32 = 2.0;
/// Part of the pixels that are darker than white.
const BELOW_WHITE: f64 = 0.9;

/// Pole of the filter that turns values into coefficients of cubic B-splines.
const POLE: f32 = -0.267_949_2;

/// Encoded brightness of a picture, smoothed over three pixels.
pub struct Brightness {
    plane: Plane,
    /// Coefficients of the cubic B-splines through it.
    splines: Plane,
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
        let encode = |pixel: &[f32; 3]| ((light(pixel) / white).powf(ENCODING)).min(MAX_BRIGHTNESS);
        let plane = smooth(&color.map(encode));
        Self {
            splines: find_splines(&plane),
            plane,
        }
    }

    /// Returns the brightness of a pixel.
    pub fn value(&self, at: usize) -> f64 {
        f64::from(self.plane.pixels[at])
    }

    /// Interpolates with cubic B-splines; none closer to the border than one pixel. Catmull-Rom's
    /// splines would move detail of four pixels by up to 0.045 pixels, these by 0.005.
    pub fn at(&self, place: DVec2) -> Option<Sample> {
        let corner = place.floor();
        let (width, height) = (self.splines.width, self.splines.height);
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
        for (row, (weight, slope)) in std::iter::zip(rows, slopes_y).enumerate() {
            let start = first + row * width as usize;
            let line = &self.splines.pixels[start..start + 4];
            let sum = |factors: &[f64; 4]| -> f64 {
                let products = line.iter().zip(factors);
                products
                    .map(|(value, factor)| f64::from(*value) * factor)
                    .sum()
            };
            let value = sum(&columns);
            sample.value += weight * value;
            sample.slope += DVec2::new(weight * sum(&slopes_x), slope * value);
        }
        Some(sample)
    }
}

/// Chooses the radiance that counts as white in some pictures; above 0.
pub fn choose_white(pictures: [&Image; 2]) -> f32 {
    let all = pictures.iter().flat_map(|picture| &picture.pixels);
    let mut values: Vec<f32> = all.map(light).filter(|value| *value > 0.0).collect();
    values.sort_by(f32::total_cmp);
    let at = (values.len() as f64 * BELOW_WHITE) as usize;
    values.get(at).copied().unwrap_or(1.0)
}

/// Returns the luminance of a pixel; 0 where a filter of the engine has left less.
fn light(pixel: &[f32; 3]) -> f32 {
    luminance(*pixel).max(0.0)
}

/// Smooths with the weights 1, 2, 1 in both directions.
fn smooth(plane: &Plane) -> Plane {
    let wide = plane.widened(1);
    Raster::from_fn(plane.width, plane.height, |x, y| {
        let row = |y: u32| 0.25 * (wide.at(x, y) + 2.0 * wide.at(x + 1, y) + wide.at(x + 2, y));
        0.25 * (row(y) + 2.0 * row(y + 1) + row(y + 2))
    })
}

/// Computes the coefficients of the splines through a plane's values, row by row and then column by
/// column.
fn find_splines(plane: &Plane) -> Plane {
    let mut splines = plane.clone();
    let (width, height) = (plane.width as usize, plane.height as usize);
    for row in 0..height {
        find_line(&mut splines.pixels, row * width, 1, width);
    }
    for column in 0..width {
        find_line(&mut splines.pixels, column, width, height);
    }
    splines
}

/// Filters one line forwards and backwards; the picture is even beyond its ends.
fn find_line(values: &mut [f32], first: usize, step: usize, count: usize) {
    let at = |index: usize| first + index * step;
    values[at(0)] /= 1.0 - POLE;
    for index in 1..count {
        values[at(index)] += POLE * values[at(index - 1)];
    }
    values[at(count - 1)] *= -POLE / (1.0 - POLE);
    for index in (0..count - 1).rev() {
        values[at(index)] = POLE * (values[at(index + 1)] - values[at(index)]);
    }
    for index in 0..count {
        values[at(index)] *= 6.0;
    }
}

/// Weights of four coefficients around a place between the second and the third.
fn weights(t: f64) -> [f64; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        (1.0 - t).powi(3) / 6.0,
        (3.0 * t3 - 6.0 * t2 + 4.0) / 6.0,
        (-3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0) / 6.0,
        t3 / 6.0,
    ]
}

/// Derivatives of [`weights`].
fn slopes(t: f64) -> [f64; 4] {
    let t2 = t * t;
    [
        -0.5 * (1.0 - t).powi(2),
        1.5 * t2 - 2.0 * t,
        -1.5 * t2 + t + 0.5,
        0.5 * t2,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_and_slope_between_pixels_are_those_of_a_wave() {
        let turn = std::f64::consts::TAU / 8.0;
        let wave = |x: f64, y: f64| 0.5 + 0.2 * (turn * x).sin() + 0.1 * (turn * y).cos();
        let picture = Raster::from_fn(40, 32, |x, y| {
            [wave(f64::from(x), f64::from(y)).powf(2.2) as f32; 3]
        });
        let sample = Brightness::of(&picture, 1.0)
            .at(DVec2::new(19.3, 14.8))
            .unwrap();
        // Smoothing with 1, 2, 1 shrinks a wave of 8 pixels.
        let shrunk = 0.5 + 0.5 * turn.cos();
        let value = 0.5 + shrunk * (wave(19.3, 14.8) - 0.5);
        assert!(
            (sample.value - value).abs() < 1e-3,
            "{}, {value}",
            sample.value
        );
        let slope =
            shrunk * turn * DVec2::new(0.2 * (turn * 19.3).cos(), -0.1 * (turn * 14.8).sin());
        assert!(
            sample.slope.distance(slope) < 2e-3,
            "{}, {slope}",
            sample.slope
        );
    }
}
