//! Scale of Bradley and Terry: strengths of things of which people chose one of two.
//!
//! A thing of strength a is chosen over one of strength b with the probability 1 / (1 + exp(b - a)) (Bradley and Terry, "Rank
//! analysis of incomplete block designs: I", Biometrika 39, 1952, 324-345). Thurstone's case V has the normal distribution in place
//! of the logistic one. Both rank alike and differ little in the middle; here a step of the scale is a ratio of odds, which two counts
//! give without a table.

use crate::paired_counts::PairedCounts;

/// Penalty of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Penalty {
    /// None: the most likely strengths. They are infinite where no thing of one group was ever chosen over one of another.
    None,
    /// That of Jeffreys' prior (Firth, "Bias reduction of maximum likelihood estimates", Biometrika 80, 1993, 27-38). Strengths are
    /// always finite, and less biased than the most likely ones. For two things it adds half a choice to either count.
    Jeffreys,
}

/// Reason why there are no strengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoScale {
    /// Some things were never compared with others, not even through a third one.
    NotConnected,
    /// Some things were never chosen over others, and nothing holds their strengths.
    Separated,
}

/// Strengths, in natural logarithms of odds; their mean is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Strengths {
    /// One per thing.
    pub values: Vec<f64>,
    /// Standard errors against the mean of all, if every comparison were independent of the others.
    pub errors: Vec<f64>,
}

/// Upper limit on the steps of a fit; it takes about ten.
const MOST_STEPS: usize = 200;
/// Largest change of a strength in one step: farther away the quadratic model means nothing.
const LARGEST_STEP: f64 = 2.0;
/// Change of a strength at which the fit ends.
const PRECISION: f64 = 1e-10;

/// Fits strengths to counts.
///
/// # Errors
/// There is no scale: see [`NoScale`].
///
/// # Panics
/// There are fewer than two things.
pub fn fit_strengths(counts: &PairedCounts, penalty: Penalty) -> Result<Strengths, NoScale> {
    assert!(counts.items >= 2, "a scale is of two things or more");
    if counts.connected().len() > 1 {
        return Err(NoScale::NotConnected);
    }
    if penalty == Penalty::None && counts.tied().len() > 1 {
        return Err(NoScale::Separated);
    }
    let mut values = vec![0.0; counts.items];
    let mut inverse = invert(information(counts, &values), counts.items);
    for _ in 0..MOST_STEPS {
        let slopes = slopes(counts, &values, &inverse, penalty);
        let steps: Vec<f64> = (inverse.chunks(counts.items))
            .map(|row| row.iter().zip(&slopes).map(|(a, b)| a * b).sum())
            .collect();
        let largest = steps
            .iter()
            .fold(0.0_f64, |most, step| most.max(step.abs()));
        let part = (LARGEST_STEP / largest).min(1.0);
        for (value, step) in values.iter_mut().zip(&steps) {
            *value += part * step;
        }
        inverse = invert(information(counts, &values), counts.items);
        if largest < PRECISION {
            break;
        }
    }
    let mean = values.iter().sum::<f64>() / counts.items as f64;
    let shift = 1.0 / counts.items as f64;
    Ok(Strengths {
        values: values.iter().map(|value| value - mean).collect(),
        errors: (0..counts.items)
            .map(|item| {
                (inverse[item * counts.items + item] - shift)
                    .max(0.0)
                    .sqrt()
            })
            .collect(),
    })
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
fn slopes(counts: &PairedCounts, values: &[f64], inverse: &[f64], penalty: Penalty) -> Vec<f64> {
    let items = counts.items;
    let mut slopes = vec![0.0; items];
    for one in 0..items {
        for other in 0..one {
            let chance = chance(values[one] - values[other]);
            // Firth's correction adds half the leverage of a pair to either count.
            let leverage = match penalty {
                Penalty::None => 0.0,
                Penalty::Jeffreys => {
                    let variance = inverse[one * items + one] + inverse[other * items + other]
                        - 2.0 * inverse[one * items + other];
                    weight(counts, values, one, other) * variance
                }
            };
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

    /// Counts from lines of two things and how often each was chosen.
    fn counts(items: usize, lines: &[(usize, usize, u32, u32)]) -> PairedCounts {
        let mut counts = PairedCounts::new(items);
        for (one, other, first, second) in lines {
            (0..*first).for_each(|_| counts.add(*one, *other, 1.0));
            (0..*second).for_each(|_| counts.add(*one, *other, 0.0));
        }
        counts
    }

    #[track_caller]
    fn assert_near(found: &[f64], due: &[f64], tolerance: f64) {
        for (found, due) in found.iter().zip(due) {
            assert!((found - due).abs() < tolerance, "{found} {due}");
        }
        assert_eq!(found.len(), due.len());
    }

    #[test]
    fn two_things_differ_by_the_logarithm_of_their_odds() {
        for (first, second) in [(3, 1), (10, 10), (1, 40)] {
            let counts = counts(2, &[(0, 1, first, second)]);
            let [first, second] = [first, second].map(f64::from);
            let half = (first / second).ln() / 2.0;
            let found = fit_strengths(&counts, Penalty::None).unwrap();
            assert_near(&found.values, &[half, -half], 1e-9);
            // The variance of a difference of log odds is 1 / first + 1 / second, and either is half of the difference.
            let error = (1.0 / first + 1.0 / second).sqrt() / 2.0;
            assert_near(&found.errors, &[error; 2], 1e-9);
            // Jeffreys' prior adds half a choice to either (Haldane 1956; Firth 1993).
            let half = ((first + 0.5) / (second + 0.5)).ln() / 2.0;
            let found = fit_strengths(&counts, Penalty::Jeffreys).unwrap();
            assert_near(&found.values, &[half, -half], 1e-9);
        }
    }

    #[test]
    fn agresti_s_baseball_has_the_published_coefficients() {
        // "Categorical Data Analysis", 2nd edition, 2002, page 438. Counts from data/baseball.csv, coefficients and standard errors from
        // tests/baseball.Rout.save of BradleyTerry2 (Turner and Firth, "Bradley-Terry models in R: the BradleyTerry2 package",
        // Journal of Statistical Software 48(9), 2012). Baltimore, Boston, Cleveland, Detroit, Milwaukee, New York, Toronto.
        let counts = counts(
            7,
            &[
                (4, 3, 4, 3),
                (4, 6, 4, 2),
                (4, 5, 4, 3),
                (4, 1, 6, 1),
                (4, 2, 4, 2),
                (4, 0, 6, 0),
                (3, 4, 3, 3),
                (3, 6, 4, 2),
                (3, 5, 4, 3),
                (3, 1, 6, 0),
                (3, 2, 6, 1),
                (3, 0, 4, 3),
                (6, 4, 2, 5),
                (6, 3, 4, 3),
                (6, 5, 2, 4),
                (6, 1, 4, 3),
                (6, 2, 4, 2),
                (6, 0, 6, 0),
                (5, 4, 3, 3),
                (5, 3, 5, 1),
                (5, 6, 2, 5),
                (5, 1, 4, 3),
                (5, 2, 4, 2),
                (5, 0, 6, 1),
                (1, 4, 5, 1),
                (1, 3, 2, 5),
                (1, 6, 3, 3),
                (1, 5, 4, 2),
                (1, 2, 5, 2),
                (1, 0, 6, 0),
                (2, 4, 2, 5),
                (2, 3, 3, 3),
                (2, 6, 3, 4),
                (2, 5, 4, 3),
                (2, 1, 4, 2),
                (2, 0, 2, 4),
                (0, 4, 2, 5),
                (0, 3, 1, 5),
                (0, 6, 1, 6),
                (0, 5, 2, 4),
                (0, 1, 1, 6),
                (0, 2, 3, 4),
            ],
        );
        let found = fit_strengths(&counts, Penalty::None).unwrap().values;
        let above: Vec<f64> = found[1..].iter().map(|value| value - found[0]).collect();
        let due = [1.1077, 0.6839, 1.4364, 1.5814, 1.2476, 1.2945];
        // To the printed digits.
        assert_near(&above, &due, 0.5e-4);
    }

    #[test]
    fn citations_of_journals_have_the_published_abilities_and_errors() {
        // Stigler, "Citation patterns in the journals of statistics and probability", Statistical Science 9, 1994, 94-108. Counts from
        // data/citations.txt, abilities with contrasts that sum to zero from tests/BTabilities.Rout.save of BradleyTerry2. Biometrika,
        // Comm Statist, JASA, JRSS-B; the cited journal wins.
        let counts = counts(
            4,
            &[
                (1, 0, 33, 730),
                (2, 0, 320, 498),
                (3, 0, 284, 221),
                (2, 1, 813, 68),
                (3, 1, 276, 17),
                (3, 2, 325, 142),
            ],
        );
        let found = fit_strengths(&counts, Penalty::None).unwrap();
        let abilities = [0.7899221, -2.1591504, 0.3103523, 1.0588761];
        // To the printed digits. R's own iteration of the errors ends earlier.
        assert_near(&found.values, &abilities, 0.5e-7);
        let errors = [0.04333047, 0.07257974, 0.04164102, 0.05304699];
        assert_near(&found.errors, &errors, 1e-6);
    }

    #[test]
    fn without_a_penalty_there_is_no_scale_of_things_that_always_win() {
        let always = counts(3, &[(0, 1, 5, 0), (1, 2, 3, 3)]);
        let none = fit_strengths(&always, Penalty::None);
        assert_eq!(none.unwrap_err(), NoScale::Separated);
        let found = fit_strengths(&always, Penalty::Jeffreys).unwrap();
        assert!(found.values[0] > found.values[1] + 1.0, "{found:?}");
        assert!(found.values[0] < found.values[1] + 4.0, "{found:?}");
        let apart = counts(4, &[(0, 1, 5, 2), (2, 3, 3, 3)]);
        for penalty in [Penalty::None, Penalty::Jeffreys] {
            let none = fit_strengths(&apart, penalty).unwrap_err();
            assert_eq!(none, NoScale::NotConnected);
        }
    }

    #[test]
    fn penalised_strengths_are_where_likelihood_and_information_have_their_largest_product() {
        let counts = counts(4, &[(0, 1, 6, 0), (1, 2, 4, 3), (2, 3, 5, 1), (0, 3, 2, 0)]);
        let found = fit_strengths(&counts, Penalty::Jeffreys).unwrap().values;
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
