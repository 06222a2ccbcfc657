//! Directions sampled to environment maps.

use std::f64::consts::TAU;

use glam::DVec3;
use scene::EnvironmentMap;

use crate::light::lights::LightSample;

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

    #[test]
    fn a_black_map_draws_nothing() {
        let map = EnvironmentMap {
            path: "made by a test".into(),
            width: 4,
            height: 2,
            texels: vec![[0.0; 3]; 8],
            strength: 2.0,
            rotation: 0.0,
        };
        assert!(EnvironmentSampler::new(&map).is_none());
    }
}
