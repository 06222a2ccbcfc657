//! Scale of Bradley and Terry: strengths of things of which people chose one of two.
//!
//! A thing of strength a is chosen over one of strength b with the probability 1 / (1 + exp(b - a)) (Bradley and Terry, "Rank
//! analysis of incomplete block designs: I", Biometrika 39, 1952, 324-345). Thurstone's case V has the normal distribution in place
//! of the logistic one. Both rank alike and differ little in the middle; here a step of the scale is a ratio of odds, which two counts
//! give without a table.

use crate::paired_counts::PairedCounts;

/// Upper limit on the steps of a fit; it takes about ten.
const MAX_STEPS: usize = 200;
/// Largest change of a strength in one step: farther away the quadratic model means nothing.
const LARGEST_STEP: f64 = 2.0;
/// Change of a strength at which the fit ends.
const PRECISION: f64 = 1e-10;

/// Fits strengths, in natural logarithms of odds; their mean is 0. None if some things were never compared with others, not even
/// through a third one.
///
/// Strengths have the penalty of Jeffreys' prior (Firth, "Bias reduction of maximum likelihood estimates", Biometrika 80, 1993, 27-38):
/// they are always finite, and less biased than the most likely ones. For two things it adds half a choice to either count.
///
/// # Panics
/// There are fewer than two things.
pub fn fit_strengths(counts: &PairedCounts) -> Option<Vec<f64>> {
    fit_penalized(counts, 1.0)
}

/// Fits strengths with a part of the penalty. Without any they are the most likely ones: infinite where no thing of one group was ever
/// chosen over one of another.
pub fn fit_penalized(counts: &PairedCounts, penalty: f64) -> Option<Vec<f64>> {
    assert!(counts.items >= 2, "a scale is of two things or more");
    if counts.connected().len() > 1 {
        return None;
    }
    let mut values = vec![0.0; counts.items];
    for _ in 0..MAX_STEPS {
        let inverse = invert(information(counts, &values), counts.items);
        let slopes = slopes(counts, &values, &inverse, penalty);
        let steps: Vec<f64> = (inverse.chunks(counts.items))
            .map(|row| row.iter().zip(&slopes).map(|(a, b)| a * b).sum())
            .collect();
        let largest = (steps.iter()).fold(0.0_f64, |most, step| most.max(step.abs()));
        let part = (LARGEST_STEP / largest).min(1.0);
        for (value, step) in values.iter_mut().zip(&steps) {
            *value += part * step;
        }
        if largest < PRECISION {
            break;
        }
    }
    let mean = values.iter().sum::<f64>() / counts.items as f64;
    Some(values.iter().map(|value| value - mean).collect())
}

/// Returns the probability that a thing is chosen over another one, from the difference of their strengths.
pub fn chance(difference: f64) -> f64 {
    1.0 / (1.0 + (-difference).exp())
}

/// Fisher's information about the strengths, row by row, with the mean of all strengths fixed: 1 / items is added everywhere.
fn information(counts: &PairedCounts, values: &[f64]) -> Vec<f64> {
    let items = counts.items;
    let mut matrix = vec![1.0 / items as f64; items * items];
    for one in 0..items {
        for other in 0..one {
            let weight = weight(counts, values, one, other);
            matrix[one * items + one] += weight;
            matrix[other * items + other] += weight;
            matrix[one * items + other] -= weight;
            matrix[other * items + one] -= weight;
        }
    }
    matrix
}

fn weight(counts: &PairedCounts, values: &[f64], one: usize, other: usize) -> f64 {
    let chance = chance(values[one] - values[other]);
    counts.comparisons(one, other) * chance * (1.0 - chance)
}

/// Derivatives of the penalised likelihood's logarithm.
fn slopes(counts: &PairedCounts, values: &[f64], inverse: &[f64], penalty: f64) -> Vec<f64> {
    let items = counts.items;
    let mut slopes = vec![0.0; items];
    for one in 0..items {
        for other in 0..one {
            let chance = chance(values[one] - values[other]);
            // Firth's correction adds half the leverage of a pair to either count.
            let variance = inverse[one * items + one] + inverse[other * items + other]
                - 2.0 * inverse[one * items + other];
            let leverage = penalty * weight(counts, values, one, other) * variance;
            let slope = counts.wins(one, other) - counts.comparisons(one, other) * chance
                + leverage * (0.5 - chance);
            slopes[one] += slope;
            slopes[other] -= slope;
        }
    }
    slopes
}

/// Inverts a positive definite matrix by Gauss and Jordan, which needs no pivots there.
fn invert(mut matrix: Vec<f64>, size: usize) -> Vec<f64> {
    for pivot in 0..size {
        let scale = 1.0 / matrix[pivot * size + pivot];
        matrix[pivot * size + pivot] = 1.0;
        for column in 0..size {
            matrix[pivot * size + column] *= scale;
        }
        for row in (0..size).filter(|row| *row != pivot) {
            let factor = std::mem::take(&mut matrix[row * size + pivot]);
            for column in 0..size {
                matrix[row * size + column] -= factor * matrix[pivot * size + column];
            }
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts how often the thing of a row was chosen over that of a column.
    fn counts<const N: usize>(wins: [[u32; N]; N]) -> PairedCounts {
        let mut counts = PairedCounts::new(N);
        for (one, row) in wins.iter().enumerate() {
            for (other, wins) in row.iter().enumerate() {
                (0..*wins).for_each(|_| counts.add(one, other, 1.0));
            }
        }
        counts
    }

    #[track_caller]
    fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < tolerance, "{found} {expected}");
        }
        assert_eq!(found.len(), expected.len());
    }

    #[test]
    fn two_things_differ_by_the_logarithm_of_their_odds() {
        for (first, second) in [(3, 1), (10, 10), (1, 40)] {
            let counts = counts([[0, first], [second, 0]]);
            let [first, second] = [first, second].map(f64::from);
            // Jeffreys' prior adds half a choice to either (Haldane 1956; Firth 1993).
            for (penalty, added) in [(0.0, 0.0), (1.0, 0.5)] {
                let half = ((first + added) / (second + added)).ln() / 2.0;
                let found = fit_penalized(&counts, penalty).unwrap();
                assert_near(&found, &[half, -half], 1e-9);
            }
        }
    }

    #[test]
    fn agresti_s_baseball_has_the_published_coefficients() {
        // "Categorical Data Analysis", 2nd edition, 2002, page 438. Counts from data/baseball.csv, at home and away together, coefficients from
        // tests/baseball.Rout.save of BradleyTerry2 (Turner and Firth, "Bradley-Terry models in R: the BradleyTerry2 package",
        // Journal of Statistical Software 48(9), 2012). Baltimore, Boston, Cleveland, Detroit, Milwaukee, New York, Toronto.
        let counts = counts([
            [0, 1, 7, 4, 2, 3, 1],
            [12, 0, 7, 2, 6, 7, 6],
            [6, 6, 0, 4, 4, 6, 5],
            [9, 11, 9, 0, 6, 5, 7],
            [11, 7, 9, 7, 0, 7, 9],
            [10, 6, 7, 8, 6, 0, 6],
            [12, 7, 8, 6, 4, 7, 0],
        ]);
        let found = fit_penalized(&counts, 0.0).unwrap();
        let above: Vec<f64> = found[1..].iter().map(|value| value - found[0]).collect();
        let expected = [1.1077, 0.6839, 1.4364, 1.5814, 1.2476, 1.2945];
        // To the printed digits.
        assert_near(&above, &expected, 0.5e-4);
    }

    #[test]
    fn citations_of_journals_have_the_published_abilities() {
        // Stigler, "Citation patterns in the journals of statistics and probability", Statistical Science 9, 1994, 94-108. Counts from
        // data/citations.txt, abilities with contrasts that sum to zero from tests/BTabilities.Rout.save of BradleyTerry2. Biometrika,
        // Comm Statist, JASA, JRSS-B; the cited journal wins.
        let counts = counts([
            [0, 730, 498, 221],
            [33, 0, 68, 17],
            [320, 813, 0, 142],
            [284, 276, 325, 0],
        ]);
        let found = fit_penalized(&counts, 0.0).unwrap();
        let abilities = [0.7899221, -2.1591504, 0.3103523, 1.0588761];
        // To the printed digits.
        assert_near(&found, &abilities, 0.5e-7);
    }

    #[test]
    fn things_that_always_win_have_finite_strengths_and_things_apart_have_none() {
        let always = counts([[0, 5, 0], [0, 0, 3], [0, 3, 0]]);
        let found = fit_strengths(&always).unwrap();
        assert!(found[0] > found[1] + 1.0, "{found:?}");
        assert!(found[0] < found[1] + 4.0, "{found:?}");
        let apart = counts([[0, 5, 0, 0], [2, 0, 0, 0], [0, 0, 0, 3], [0, 0, 3, 0]]);
        assert_eq!(fit_strengths(&apart), None);
    }

    #[test]
    fn penalised_strengths_are_where_likelihood_and_information_have_their_largest_product() {
        let counts = counts([[0, 6, 0, 2], [0, 0, 4, 0], [0, 3, 0, 5], [0, 0, 1, 0]]);
        let found = fit_strengths(&counts).unwrap();
        // Logarithm of likelihood times root of the information's determinant.
        let objective = |values: &[f64]| {
            let mut likelihood = 0.0;
            for one in 0..4 {
                for other in (0..4).filter(|other| *other != one) {
                    likelihood +=
                        counts.wins(one, other) * chance(values[one] - values[other]).ln();
                }
            }
            let mut matrix = information(&counts, values);
            let mut determinant = 1.0;
            for pivot in 0..4 {
                determinant *= matrix[pivot * 4 + pivot];
                for row in pivot + 1..4 {
                    let factor = matrix[row * 4 + pivot] / matrix[pivot * 4 + pivot];
                    for column in 0..4 {
                        matrix[row * 4 + column] -= factor * matrix[pivot * 4 + column];
                    }
                }
            }
            likelihood + 0.5 * determinant.ln()
        };
        let best = objective(&found);
        for item in 0..4 {
            for step in [-1e-3, 1e-3] {
                let mut moved = found.clone();
                moved[item] += step;
                assert!(objective(&moved) < best, "{item} {step}");
            }
        }
    }
}
