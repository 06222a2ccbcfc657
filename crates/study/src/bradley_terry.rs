//! Bradley-Terry scale: strengths of things from choices between two of them.
//!
//! A thing of strength a is chosen over one of strength b with the probability 1 / (1 + exp(b - a)) (Bradley and Terry, "Rank
//! analysis of incomplete block designs: I", Biometrika 39, 1952, 324-345). Thurstone's case V uses the normal distribution instead
//! of the logistic one. Both rank alike and differ little in the middle; here a step of the scale is a ratio of odds, which two
//! counts give without a table.

use nalgebra::{DMatrix, DVector};

use crate::paired_counts::PairedCounts;

/// Upper limit on the steps of a fit; it takes about ten.
const MAX_STEPS: usize = 200;
/// Largest change of a strength in one step: the quadratic model does not hold farther away.
const LARGEST_STEP: f64 = 2.0;
/// Change of a strength at which the fit ends.
const PRECISION: f64 = 1e-10;

/// Fits strengths of two things or more, in natural logarithms of odds; their mean is 0. None if some things were never compared
/// with others, not even through a third one.
///
/// The penalty of Jeffreys' prior (Firth, "Bias reduction of maximum likelihood estimates", Biometrika 80, 1993, 27-38) keeps
/// strengths finite, and less biased than the most likely ones. For two things it adds half a choice to each count.
pub fn fit_strengths(counts: &PairedCounts) -> Option<Vec<f64>> {
    fit_penalized(counts, 1.0)
}

/// Fits strengths with a part of the penalty. Without it they are the most likely ones: infinite if no thing of one group was ever
/// chosen over one of another.
fn fit_penalized(counts: &PairedCounts, penalty: f64) -> Option<Vec<f64>> {
    if counts.connected().len() > 1 {
        return None;
    }
    let mut values = DVector::zeros(counts.items());
    for _ in 0..MAX_STEPS {
        let inverse = information(counts, &values).try_inverse()?;
        let step = &inverse * slopes(counts, &values, &inverse, penalty);
        let largest = step.amax();
        values += (LARGEST_STEP / largest).min(1.0) * step;
        if largest < PRECISION {
            break;
        }
    }
    let mean = values.mean();
    Some(values.iter().map(|value| value - mean).collect())
}

/// Returns the probability that a thing is chosen over another one, from the difference of their strengths.
pub fn chance(difference: f64) -> f64 {
    1.0 / (1.0 + (-difference).exp())
}

/// Fisher's information about the strengths, with the mean of all strengths fixed: 1 / items is added everywhere.
fn information(counts: &PairedCounts, values: &DVector<f64>) -> DMatrix<f64> {
    let items = counts.items();
    let mut matrix = DMatrix::from_element(items, items, 1.0 / items as f64);
    for one in 0..items {
        for other in 0..one {
            let weight = weight(counts, values, one, other);
            matrix[(one, one)] += weight;
            matrix[(other, other)] += weight;
            matrix[(one, other)] -= weight;
            matrix[(other, one)] -= weight;
        }
    }
    matrix
}

fn weight(counts: &PairedCounts, values: &DVector<f64>, one: usize, other: usize) -> f64 {
    let chance = chance(values[one] - values[other]);
    counts.comparisons(one, other) * chance * (1.0 - chance)
}

/// Derivatives of the penalised likelihood's logarithm.
fn slopes(
    counts: &PairedCounts,
    values: &DVector<f64>,
    inverse: &DMatrix<f64>,
    penalty: f64,
) -> DVector<f64> {
    let slope = |one: usize, other: usize| {
        let chance = chance(values[one] - values[other]);
        // Firth's correction adds half the leverage of a pair to either count.
        let variance = inverse[(one, one)] + inverse[(other, other)] - 2.0 * inverse[(one, other)];
        let leverage = penalty * weight(counts, values, one, other) * variance;
        counts.wins[(one, other)] - counts.comparisons(one, other) * chance
            + leverage * (0.5 - chance)
    };
    DVector::from_fn(counts.items(), |one, _| {
        let others = (0..counts.items()).filter(|other| *other != one);
        others.map(|other| slope(one, other)).sum()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts how often the row's thing was chosen over the column's.
    fn counts<const N: usize>(wins: [[u32; N]; N]) -> PairedCounts {
        let wins = DMatrix::from_fn(N, N, |one, other| f64::from(wins[one][other]));
        PairedCounts { wins }
    }

    #[test]
    fn citations_of_journals_have_the_published_abilities() {
        // Stigler, "Citation patterns in the journals of statistics and probability", Statistical Science 9, 1994, 94-108. Counts from
        // data/citations.txt, abilities with contrasts that sum to zero from tests/BTabilities.Rout.save of BradleyTerry2 (Turner and
        // Firth, "Bradley-Terry models in R: the BradleyTerry2 package", Journal of Statistical Software 48(9), 2012). Biometrika,
        // Comm Statist, JASA, JRSS-B; the cited journal wins.
        let counts = counts([
            [0, 730, 498, 221],
            [33, 0, 68, 17],
            [320, 813, 0, 142],
            [284, 276, 325, 0],
        ]);
        let found = fit_penalized(&counts, 0.0).unwrap();
        let expected = [0.7899221, -2.1591504, 0.3103523, 1.0588761];
        for (found, expected) in found.iter().zip(expected) {
            // To the printed digits.
            assert!((found - expected).abs() < 0.5e-7, "{found} {expected}");
        }
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
        let found = DVector::from(fit_strengths(&counts).unwrap());
        // Logarithm of likelihood times root of the information's determinant.
        let objective = |values: &DVector<f64>| {
            let likelihood = counts.wins.map_with_location(|one, other, wins| {
                wins * chance(values[one] - values[other]).ln()
            });
            likelihood.sum() + 0.5 * information(&counts, values).determinant().ln()
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
