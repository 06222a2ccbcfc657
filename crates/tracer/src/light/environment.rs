//! Environment maps: radiance from infinity as an image of all directions.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3, Vec3};

use crate::light::lights::LightSample;
use crate::scene::EnvironmentMap;

impl EnvironmentMap {
    /// Radiance from a unit direction: bilinear, wrapped around the horizon and clamped at the
    /// poles.
    pub fn radiance(&self, direction: DVec3) -> Vec3 {
        let [x, y] = self.place(direction).map(|part| part - 0.5);
        let [left, top] = [x.floor(), y.floor()];
        let [across, down] = [(x - left) as f32, (y - top) as f32];
        let texel = |dx: i64, dy: i64| self.texel(left as i64 + dx, top as i64 + dy);
        let upper = texel(0, 0).lerp(texel(1, 0), across);
        let lower = texel(0, 1).lerp(texel(1, 1), across);
        self.strength * upper.lerp(lower, down)
    }

    fn texel(&self, column: i64, row: i64) -> Vec3 {
        let column = column.rem_euclid(i64::from(self.width)) as usize;
        let row = row.clamp(0, i64::from(self.height) - 1) as usize;
        Vec3::from(self.texels[row * self.width as usize + column])
    }

    /// The place of a unit direction in the image, in texels from its top left.
    fn place(&self, direction: DVec3) -> [f64; 2] {
        let local = DMat3::from_rotation_y(-self.rotation) * direction;
        let azimuth = local.x.atan2(-local.z);
        let polar = local.y.clamp(-1.0, 1.0).acos();
        [
            (azimuth / TAU + 0.5) * f64::from(self.width),
            polar / PI * f64::from(self.height),
        ]
    }

    /// The texel that contains a unit direction.
    fn cell(&self, direction: DVec3) -> usize {
        let [x, y] = self.place(direction);
        let column = (x as usize).min(self.width as usize - 1);
        let row = (y as usize).min(self.height as usize - 1);
        row * self.width as usize + column
    }

    /// The direction at an azimuth, as a part of the image's width, and a height above the horizon,
    /// as a sine.
    fn direction(&self, across: f64, height: f64) -> DVec3 {
        let (sine, cosine) = (TAU * (across - 0.5)).sin_cos();
        let level = (1.0 - height * height).max(0.0).sqrt();
        DMat3::from_rotation_y(self.rotation) * DVec3::new(level * sine, height, -level * cosine)
    }

    /// The height above the horizon of a row's upper border, as a sine.
    fn border(&self, row: usize) -> f64 {
        (PI * row as f64 / f64::from(self.height)).cos()
    }
}

/// Draws directions of an environment map roughly in proportion to its radiance.
///
/// A texel is chosen by the mean of itself and its neighbours, so that every direction that
/// interpolation makes bright can be sampled. Within a texel directions are sampled evenly.
pub(crate) struct EnvironmentSampler {
    /// Probability per steradian of each texel.
    densities: Vec<f64>,
    /// Probability of each row or one above it.
    rows: Vec<f64>,
    /// Probability within its row of each texel or one to the left.
    columns: Vec<f64>,
}

impl EnvironmentSampler {
    /// Prepares a map; none if it is black.
    pub fn new(map: &EnvironmentMap) -> Option<Self> {
        let [width, height] = [map.width as usize, map.height as usize];
        let weights = compute_weights(map);
        let area = |row: usize| (map.border(row) - map.border(row + 1)) * TAU / width as f64;
        let mut columns = Vec::with_capacity(width * height);
        let mut rows = Vec::with_capacity(height);
        let mut total = 0.0;
        for (row, weights) in weights.chunks(width).enumerate() {
            let sums = weights.iter().scan(0.0, |sum, weight| {
                *sum += weight;
                Some(*sum)
            });
            let cumulative: Vec<f64> = sums.collect();
            let sum = cumulative[width - 1];
            columns.extend(
                cumulative
                    .iter()
                    .map(|part| part / sum.max(f64::MIN_POSITIVE)),
            );
            total += sum * area(row);
            rows.push(total);
        }
        (total > 0.0).then(|| Self {
            densities: weights.iter().map(|weight| weight / total).collect(),
            rows: rows.iter().map(|sum| sum / total).collect(),
            columns,
        })
    }

    /// The greatest and the least density.
    pub fn extremes(&self) -> [f64; 2] {
        let brightest = self.densities.iter().copied().fold(0.0, f64::max);
        let darkest = self.densities.iter().copied().fold(f64::INFINITY, f64::min);
        [brightest, darkest]
    }

    /// Draws a direction from two numbers in [0, 1).
    pub fn sample(&self, map: &EnvironmentMap, [u, v]: [f64; 2]) -> LightSample {
        let width = map.width as usize;
        let (row, down) = find_interval(&self.rows, v);
        let (column, across) = find_interval(&self.columns[row * width..(row + 1) * width], u);
        let [upper, lower] = [map.border(row), map.border(row + 1)];
        let direction = map.direction(
            (column as f64 + across) / width as f64,
            upper + down * (lower - upper),
        );
        LightSample {
            direction,
            distance: f64::INFINITY,
            radiance: map.radiance(direction),
            density: self.densities[row * width + column],
        }
    }

    /// The probability per steradian with which [`EnvironmentSampler::sample`] draws a unit
    /// direction.
    pub fn density(&self, map: &EnvironmentMap, direction: DVec3) -> f64 {
        self.densities[map.cell(direction)]
    }
}

/// The mean strength of each texel and its eight neighbours.
fn compute_weights(map: &EnvironmentMap) -> Vec<f64> {
    let [width, height] = [i64::from(map.width), i64::from(map.height)];
    let strength = |column, row| f64::from(map.texel(column, row).max_element());
    let mean_of_three = |column: i64, row: i64| {
        (-1..=1)
            .map(|aside| strength(column + aside, row))
            .sum::<f64>()
            / 3.0
    };
    let across: Vec<f64> = (0..width * height)
        .map(|at| mean_of_three(at % width, at / width))
        .collect();
    let at = |column: i64, row: i64| across[(row.clamp(0, height - 1) * width + column) as usize];
    (0..width * height)
        .map(|index| [index % width, index / width])
        .map(|[column, row]| (-1..=1).map(|down| at(column, row + down)).sum::<f64>() / 3.0)
        .collect()
}

/// Finds which of the intervals that end at these numbers contains `number`, and its place
/// there as a part of the length.
fn find_interval(ends: &[f64], number: f64) -> (usize, f64) {
    let index = ends
        .partition_point(|end| *end <= number)
        .min(ends.len() - 1);
    let start = if index == 0 { 0.0 } else { ends[index - 1] };
    let length = (ends[index] - start).max(f64::MIN_POSITIVE);
    (index, ((number - start) / length).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: u32, height: u32, texel: impl Fn(u32, u32) -> [f32; 3]) -> EnvironmentMap {
        EnvironmentMap {
            path: "made by a test".into(),
            width,
            height,
            texels: (0..width * height)
                .map(|at| texel(at % width, at / width))
                .collect(),
            strength: 2.0,
            rotation: 0.0,
        }
    }

    #[test]
    fn the_middle_looks_ahead_and_the_right_quarter_to_the_right() {
        let bright_at = |bright: u32| map(64, 32, |x, _| [f32::from(u8::from(x == bright)); 3]);
        let texel = TAU / 64.0;
        let at = |map: &EnvironmentMap, azimuth: f64| {
            map.radiance(DVec3::new(azimuth.sin(), 0.0, -azimuth.cos()))
                .x
        };
        // A texel's centre is half a texel right of its left border.
        assert!((at(&bright_at(32), 0.5 * texel) - 2.0).abs() < 1e-5);
        assert!((at(&bright_at(48), 0.25 * TAU + 0.5 * texel) - 2.0).abs() < 1e-5);
        // Across the seam behind, where columns 63 and 0 meet.
        assert!((at(&bright_at(63), 0.5 * TAU) - 1.0).abs() < 1e-5);
        let up = map(8, 4, |_, y| [f32::from(u8::from(y == 0)); 3]);
        assert_eq!(up.radiance(DVec3::Y), Vec3::splat(2.0));
        assert_eq!(up.radiance(DVec3::NEG_Y), Vec3::ZERO);
    }

    #[test]
    fn rotation_turns_the_map_about_y() {
        let mut turned = map(64, 32, |x, _| [x as f32; 3]);
        let before = turned.radiance(DVec3::NEG_Z);
        turned.rotation = 0.5 * PI;
        // A quarter turn about +Y takes -Z to -X.
        assert!(turned.radiance(DVec3::NEG_X).distance(before) < 1e-4);
    }

    #[test]
    fn a_black_map_draws_nothing() {
        assert!(EnvironmentSampler::new(&map(4, 2, |_, _| [0.0; 3])).is_none());
    }
}
