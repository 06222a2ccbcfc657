//! Sobol indices of functions with known indices.

use std::convert::Infallible;
use std::f64::consts::PI;

use tune::sobol_indices;

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
        let others = own.iter().map(|own| 1.0 + own).product::<f64>() / (1.0 + own[axis]);
        let (first, total) = (own[axis] / variance, own[axis] * others / variance);
        for (estimate, expected) in [(indices.first, first), (indices.total, total)] {
            // The widest interval is 0.15; an index of the wrong axis is off by at least 0.3.
            let off = (estimate.value - expected).abs();
            assert!(off < 0.1, "{axis}: {indices:?}, not {expected}");
        }
    }
    let total = |axis: usize| found[axis].total;
    assert!(total(4).high < 0.02, "it could be a constant");
    assert!(total(1).low > 0.02, "what matters could not");
}

#[test]
fn a_constant_function_has_no_sensitivity() {
    let constant = |_: &[f64]| Ok::<f64, Infallible>(3.0);
    for indices in sobol_indices(2, 16, 1, constant).unwrap() {
        assert_eq!((indices.first.value, indices.total.high), (0.0, 0.0));
    }
}
