//! Sobol indices: the share of a function's variance that each parameter causes.

use serde::{Deserialize, Serialize};
use suite::Random;

use crate::search::sobol_point;

/// Bootstrap samples of an interval.
const SAMPLES: usize = 1000;

/// Shares of the variance that one axis causes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SobolIndices {
    /// Share that it causes alone.
    pub first: Estimate,
    /// Share that would be gone if it were constant: caused alone or together with others.
    pub total: Estimate,
}

/// A value with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Value from all rows.
    pub value: f64,
    /// Lower end: 2.5 % of the bootstrap samples of rows lie below it.
    pub low: f64,
    /// Upper end: 2.5 % lie above it.
    pub high: f64,
}

/// Values of the function at one row of the two matrices, and with one coordinate at a time taken from the second.
struct Row {
    a: f64,
    b: f64,
    mixed: Vec<f64>,
}

/// Estimates the indices after Jansen (1999), from `rows` rows of a Sobol sequence: calls the function `rows` x (`axes` + 2) times
/// (Saltelli and others, "Variance based sensitivity analysis of model output", Computer Physics Communications 181, 2010,
/// table 2). All indices of a constant function are 0.
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
        let variance = values().map(|it| (it - mean).powi(2)).sum::<f64>() / count;
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

    /// Divides half of the mean of squared differences by the variance; none of a constant function.
    fn share_of_variance(&self, difference: impl Fn(&Row) -> f64) -> Option<f64> {
        let squares: f64 = self.rows.iter().map(|row| difference(row).powi(2)).sum();
        let share = squares / (2.0 * self.rows.len() as f64 * self.variance);
        (self.variance > 0.0).then_some(share)
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;
    use std::f64::consts::PI;

    use super::*;

    /// Evaluates the function of Ishigami and Homma 1990 with a = 7, b = 0.1, on the unit cube.
    fn ishigami(point: &[f64]) -> Result<f64, Infallible> {
        let [x, y, z] = [0, 1, 2].map(|axis| PI * (2.0 * point[axis] - 1.0));
        Ok(x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin())
    }

    /// Coefficients of Sobol's g-function; the first parameters matter most.
    const G: [f64; 6] = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];

    fn g_function(point: &[f64]) -> Result<f64, Infallible> {
        let factor = |(x, a): (&f64, f64)| ((4.0 * x - 2.0).abs() + a) / (1.0 + a);
        Ok(point.iter().zip(G).map(factor).product())
    }

    #[test]
    fn the_indices_of_ishigami_s_function_equal_the_published_ones() {
        let found = sobol_indices(3, 1024, 1, ishigami).unwrap();
        // Closed form: variance 13.845; first-order indices 0.3139, 0.4424 and 0; total indices 0.5576, 0.4424 and 0.2437.
        let expected = [(0.3139, 0.5576), (0.4424, 0.4424), (0.0, 0.2437)];
        for (indices, (first, total)) in found.iter().zip(expected) {
            for (estimate, expected) in [(indices.first, first), (indices.total, total)] {
                // Four standard errors of 1024 rows, about a quarter of the intervals' widths.
                let tolerance = estimate.high - estimate.low;
                let off = (estimate.value - expected).abs();
                assert!(off < tolerance && tolerance < 0.25, "{indices:?}");
            }
        }
    }

    #[test]
    fn the_indices_of_sobols_g_function_follow_its_formula() {
        let found = sobol_indices(6, 1024, 1, g_function).unwrap();
        let own = G.map(|a| 1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
        let variance = own.iter().map(|own| 1.0 + own).product::<f64>() - 1.0;
        for (axis, indices) in found.iter().enumerate() {
            let others: f64 = (0..6)
                .filter(|it| *it != axis)
                .map(|it| 1.0 + own[it])
                .product();
            let (first, total) = (own[axis] / variance, own[axis] * others / variance);
            for (estimate, expected) in [(indices.first, first), (indices.total, total)] {
                // The widest interval is 0.15; an index of the wrong axis is off by at least 0.3.
                let off = (estimate.value - expected).abs();
                assert!(off < 0.1, "{axis}: {indices:?}, not {expected}");
            }
        }
        let total = |axis: usize| found[axis].total;
        assert!(
            total(4).high < 0.02,
            "what hardly matters could be a constant"
        );
        assert!(total(1).low > 0.02, "what matters could not");
    }

    #[test]
    fn a_constant_function_has_no_sensitivity() {
        let constant = |_: &[f64]| Ok::<f64, Infallible>(3.0);
        for indices in sobol_indices(2, 16, 1, constant).unwrap() {
            assert_eq!((indices.first.value, indices.total.high), (0.0, 0.0));
        }
    }
}
