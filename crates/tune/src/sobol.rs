//! Sobol indices: the share of a function's variance that each parameter causes.

use measure::Random;
use serde::{Deserialize, Serialize};

use crate::search::sobol_point;

/// Bootstrap samples of an interval.
const SAMPLES: usize = 1000;

/// Shares of the variance that one axis causes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SobolIndices {
    /// Share that it causes alone.
    pub first: Estimate,
    /// Share that would vanish if it were constant: caused alone or together with others.
    pub total: Estimate,
}

/// A value with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Value from all rows.
    pub value: f64,
    /// Lower end: 2.5 % of the bootstrap samples of rows are below it.
    pub low: f64,
    /// Upper end: 2.5 % are above it.
    pub high: f64,
}

/// Values of the function at one row of the two matrices, and with one coordinate at a time taken
/// from the second.
struct Row {
    a: f64,
    b: f64,
    mixed: Vec<f64>,
}

/// Estimates the indices after Jansen (1999), from `rows` rows of a Sobol sequence: calls the
/// function `rows` x (`axes` + 2) times (Saltelli and others, "Variance based sensitivity analysis
/// of model output", Computer Physics Communications 181, 2010, table 2). All indices of a constant
/// function are 0.
pub fn sobol_indices<E>(
    axes: usize,
    rows: usize,
    seed: u64,
    mut function: impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<SobolIndices>, E> {
    assert!(rows >= 2, "one row has no variance");
    let mut asked = Vec::new();
    for index in 0..rows as u32 {
        let point = sobol_point(index, 2 * axes, seed);
        let (a, b) = point.split_at(axes);
        let mut mixed = Vec::new();
        for axis in 0..axes {
            let mut point = a.to_vec();
            point[axis] = b[axis];
            mixed.push(function(&point)?);
        }
        asked.push(Row {
            a: function(a)?,
            b: function(b)?,
            mixed,
        });
    }
    let mut random = Random(seed);
    let samples: Vec<Sample> = (0..SAMPLES)
        .map(|_| Sample::new((0..rows).map(|_| &asked[random.below(rows)]).collect()))
        .collect();
    let all = Sample::new(asked.iter().collect());
    let estimate = |axis: usize, index: fn(&Sample, usize) -> f64| {
        let mut values: Vec<f64> = samples.iter().map(|rows| index(rows, axis)).collect();
        values.sort_by(f64::total_cmp);
        let at = |part: f64| values[(part * (SAMPLES - 1) as f64).round() as usize];
        Estimate {
            value: index(&all, axis),
            low: at(0.025),
            high: at(0.975),
        }
    };
    Ok((0..axes)
        .map(|axis| SobolIndices {
            first: estimate(axis, |sample, axis| sample.first_index(axis)),
            total: estimate(axis, |sample, axis| sample.total_index(axis)),
        })
        .collect())
}

/// Rows, some of them several times, with the variance of their values.
struct Sample<'a> {
    rows: Vec<&'a Row>,
    variance: f64,
}

impl<'a> Sample<'a> {
    fn new(rows: Vec<&'a Row>) -> Self {
        let values = || rows.iter().flat_map(|row| [row.a, row.b]);
        let count = 2.0 * rows.len() as f64;
        let mean = values().sum::<f64>() / count;
        let variance = values().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
        Self { rows, variance }
    }

    fn first_index(&self, axis: usize) -> f64 {
        let share = self.share_of_variance(|row| row.b - row.mixed[axis]);
        share.map_or(0.0, |share| 1.0 - share)
    }

    fn total_index(&self, axis: usize) -> f64 {
        let share = self.share_of_variance(|row| row.a - row.mixed[axis]);
        share.unwrap_or(0.0)
    }

    /// Divides half the mean squared difference by the variance; none for a constant function.
    fn share_of_variance(&self, difference: impl Fn(&Row) -> f64) -> Option<f64> {
        let squares: f64 = self.rows.iter().map(|row| difference(row).powi(2)).sum();
        let share = squares / (2.0 * self.rows.len() as f64 * self.variance);
        (self.variance > 0.0).then_some(share)
    }
}
