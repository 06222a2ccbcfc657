//! Jackknife intervals of scores against a noisy truth.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Confidence: the fraction of intervals that contain the converged score.
const CONFIDENCE: f64 = 0.95;

/// 95 % confidence interval of the score against a truth without noise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Lower end, in the metric's unit.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Estimate of the score against a truth without noise.
    pub center: f64,
    /// Standard error of the score.
    pub standard_error: f64,
}

impl Interval {
    /// Returns whether the interval contains the measured value. It may not: noise moves the score, and the
    /// interval is for a truth without noise.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// Estimates the interval of a score. `whole` is its value from all of the truth's replicates; each value of `without` leaves
/// out one of several equal groups of them. `None` for fewer than two groups.
///
/// This is the grouped jackknife (Quenouille 1956, Tukey 1958; Efron and Tibshirani, "An Introduction to the Bootstrap", 1993,
/// chapter 11). It assumes that the score is a smooth, not a linear, function of the truth. For G groups, m being the mean of
/// `without`:
///
/// - the squared standard error is (G - 1) / G times the sum of (without - m)^2,
/// - the centre is `whole` + (G - 1)(`whole` - m): more replicates raise a score less. If the rise goes with the inverse of their number,
///   the remaining rise is G - 1 times that of leaving a group out,
/// - the half width is the standard error times the quantile of Student's t of G - 1 degrees of freedom.
///
/// The noise of a truth falls with the root of the number of its replicates. A mean of absolute errors rises by the inverse of
/// that number if few errors are smaller than the noise, but by as much as the noise, its inverse root, if the picture is
/// perfect. The remaining rise is then 1 / (root(G / (G - 1)) - 1) times that of leaving a group out. Most scores are in
/// between, so the interval reaches from one centre to the other, and a half width beyond both.
pub fn jackknife(whole: f64, without: &[f64]) -> Option<Interval> {
    let mut found = jackknife_by_inverse(whole, without)?;
    let count = without.len() as f64;
    let raised = without.iter().map(|value| value - whole).sum::<f64>() / count;
    let center_by_root = whole - raised / ((count / (count - 1.0)).sqrt() - 1.0);
    let apart = center_by_root - found.center;
    found.low += apart.min(0.0);
    found.high += apart.max(0.0);
    Some(found)
}

/// Estimates the interval of a percentile. A percentile is not a smooth function of the truth: leaving groups out
/// estimates its noise poorly, and its bias worse. So the interval has one centre, by the inverse, and is wider by the
/// score's noise floor at each end.
pub fn jackknife_of_percentile(whole: f64, without: &[f64], floor: f64) -> Option<Interval> {
    let mut found = jackknife_by_inverse(whole, without)?;
    found.low -= floor;
    found.high += floor;
    Some(found)
}

/// Estimates the interval of a score that noise raises by the inverse of the replicates.
fn jackknife_by_inverse(whole: f64, without: &[f64]) -> Option<Interval> {
    if without.len() < 2 {
        return None;
    }
    let count = without.len() as f64;
    // Rise of the score without each group: exactly 0 for a score that no group changes.
    let raised: Vec<f64> = without.iter().map(|value| value - whole).collect();
    let mean = raised.iter().sum::<f64>() / count;
    let squares: f64 = raised.iter().map(|value| (value - mean).powi(2)).sum();
    let standard_error = ((count - 1.0) / count * squares).sqrt();
    let center = whole - (count - 1.0) * mean;
    let half_width = standard_error * quantile(count - 1.0);
    Some(Interval {
        low: center - half_width,
        high: center + half_width,
        center,
        standard_error,
    })
}

/// Returns the two-sided critical value of Student's t at the wanted confidence.
fn quantile(degrees_of_freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, degrees_of_freedom)
        .expect("two groups have a degree of freedom")
        .inverse_cdf(0.5 + CONFIDENCE / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Averages all numbers, and all but each in turn.
    fn means(numbers: &[f64]) -> (f64, Vec<f64>) {
        let mean = |left_out: usize| {
            let others = (0..numbers.len()).filter(|index| *index != left_out);
            others.clone().map(|index| numbers[index]).sum::<f64>() / others.count() as f64
        };
        (mean(usize::MAX), (0..numbers.len()).map(mean).collect())
    }

    #[test]
    fn the_interval_of_a_mean_is_the_textbooks() {
        let (whole, without) = means(&[1.0, 2.0, 4.0, 7.0]);
        let interval = jackknife(whole, &without).unwrap();
        // s = sqrt(7) over the root of 4, and the table's t for 3 degrees of freedom, 3.182: to its digits.
        let error = 7f64.sqrt() / 2.0;
        assert!(
            (interval.standard_error - error).abs() < 1e-12,
            "{interval:?}"
        );
        assert!(
            (interval.high - (3.5 + 3.182 * error)).abs() < 1e-3,
            "{interval:?}"
        );
        assert!(
            (interval.low - (3.5 - 3.182 * error)).abs() < 1e-3,
            "{interval:?}"
        );
    }

    #[test]
    fn noise_that_falls_with_the_replicates_is_taken_out() {
        // The square of a mean is too high by the variance of the mean, and the jackknife of it is unbiased.
        let numbers = [1.0, 2.0, 4.0, 7.0];
        let (whole, without) = means(&numbers);
        let squares: Vec<f64> = without.iter().map(|mean| mean * mean).collect();
        let interval = jackknife(whole * whole, &squares).unwrap();
        // 3.5^2 less s^2 / 4 = 7 / 4.
        assert!(
            (interval.center - (12.25 - 1.75)).abs() < 1e-12,
            "{interval:?}"
        );
    }

    #[test]
    fn noise_that_falls_with_the_root_of_the_replicates_is_held() {
        // The mean absolute error of a perfect picture, for noise of 1 in each group: its limit is 0.
        let noise = |groups: f64| 1.0 / groups.sqrt();
        let interval = jackknife(noise(4.0), &[noise(3.0); 4]).unwrap();
        assert!(interval.low.abs() < 1e-12, "{interval:?}");
        // By the inverse of the replicates, half of it would be left.
        assert!((interval.high - 0.268).abs() < 1e-3, "{interval:?}");
        assert_eq!(interval.high, interval.center);
        // A percentile has one centre.
        let interval = jackknife_of_percentile(noise(4.0), &[noise(3.0); 4], 0.1).unwrap();
        assert!((interval.high - interval.center - 0.1).abs() < 1e-12);
        assert!((interval.center - interval.low - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_score_that_no_group_changes_is_known_exactly() {
        // A tenth three times does not add up to three tenths.
        let interval = jackknife(0.1, &[0.1; 3]).unwrap();
        assert_eq!(
            [interval.low, interval.high, interval.standard_error],
            [0.1, 0.1, 0.0]
        );
    }

    #[test]
    fn one_group_says_nothing() {
        assert_eq!(jackknife(1.0, &[2.0]), None);
    }
}
