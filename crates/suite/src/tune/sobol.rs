//! Sobol indices: which part of a function's variance each parameter causes.

use serde::{Deserialize, Serialize};

use super::random::Random;
use super::search::sobol;

/// Samples of rows behind an interval.
const SAMPLES: usize = 1000;

/// What one axis causes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SobolIndices {
    /// Part of the variance that it causes alone.
    pub first: Estimate,
    /// Part that would be gone if it were constant: alone or together with others.
    pub total: Estimate,
}

/// A value with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// From all rows.
    pub value: f64,
    /// Below it lie 2.5 % of what samples of the rows give.
    pub low: f64,
    /// Above it lie 2.5 %.
    pub high: f64,
}

/// What a function is at one row of the two matrices, and with one coordinate at a time taken from the second.
struct Row {
    a: f64,
    b: f64,
    mixed: Vec<f64>,
}

/// Estimates after Jansen (1999), from `rows` rows of a Sobol sequence, which ask `rows` x (`axes` + 2) times (Saltelli and
/// others, "Variance based sensitivity analysis of model output", Computer Physics Communications 181, 2010, table 2).
/// All 0 where the function is constant.
pub fn sobol_indices<E>(
    axes: usize,
    rows: usize,
    seed: u64,
    mut function: impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<SobolIndices>, E> {
    assert!(rows >= 2, "one row has no variance");
    let mut asked = Vec::new();
    for index in 0..rows as u32 {
        let point = sobol(index, 2 * axes, seed);
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
    let samples: Vec<Vec<&Row>> = (0..SAMPLES)
        .map(|_| (0..rows).map(|_| &asked[random.below(rows)]).collect())
        .collect();
    let all: Vec<&Row> = asked.iter().collect();
    let estimate = |axis: usize, index: fn(&[&Row], usize) -> f64| {
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
            first: estimate(axis, first),
            total: estimate(axis, total),
        })
        .collect())
}

fn first(rows: &[&Row], axis: usize) -> f64 {
    part(
        rows,
        |row| (row.b - row.mixed[axis]).powi(2),
        |left| 1.0 - left,
    )
}

fn total(rows: &[&Row], axis: usize) -> f64 {
    part(rows, |row| (row.a - row.mixed[axis]).powi(2), |left| left)
}

/// Half of the mean of squares, as a part of the variance.
fn part(rows: &[&Row], square: impl Fn(&Row) -> f64, index: impl Fn(f64) -> f64) -> f64 {
    let variance = variance(rows);
    if variance <= 0.0 {
        return 0.0;
    }
    let squares: f64 = rows.iter().map(|row| square(row)).sum();
    index(squares / (2.0 * rows.len() as f64 * variance))
}

fn variance(rows: &[&Row]) -> f64 {
    let values = || rows.iter().flat_map(|row| [row.a, row.b]);
    let count = 2.0 * rows.len() as f64;
    let mean = values().sum::<f64>() / count;
    values().map(|it| (it - mean).powi(2)).sum::<f64>() / count
}
