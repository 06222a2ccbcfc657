//! Jackknife intervals of scores of noisy pictures against a noisy truth.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Confidence: the fraction of intervals that contain the converged score.
const CONFIDENCE: f64 = 0.95;

/// 95 % confidence interval of the score that a frame and a truth without noise would give.
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
    /// Returns whether the interval contains the measured value. It may not: noise moves the score,
    /// and the interval is for a truth without noise.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// How noise in the pictures raises a score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rise {
    /// By the inverse of the number of replicates: a smooth score of errors that are larger than
    /// the noise.
    Inverse,
    /// By a power of that number, between this one and the inverse. A mean of absolute errors rises
    /// by the inverse if few errors are smaller than the noise, and by the noise itself, the
    /// inverse root, if the picture is perfect.
    Power(f64),
    /// Little, and less than parts of the replicates can tell: a percentile is no smooth function
    /// of the pictures. Over nearly perfect pictures it may rise by a power, too.
    Percentile(Option<f64>),
}

/// Estimates the interval of a score that noise raises by the inverse of the replicates: see
/// [`jackknife_of`].
pub fn jackknife(whole: f64, without: &[f64]) -> Option<Interval> {
    jackknife_of(whole, without, Rise::Inverse)
}

/// Estimates the interval of a score. `whole` is its value from all replicates of the pictures that
/// go into it; each value of `without` leaves out one of several equal groups of them. `None` for
/// fewer than two groups.
///
/// This is the grouped jackknife (Quenouille 1956, Tukey 1958; Efron and Tibshirani, "An
/// Introduction to the Bootstrap", 1993, chapter 11). For G groups, m being the mean of `without`:
///
/// - The squared standard error is (G - 1) / G times the sum of (without - m)^2.
/// - The centre is `whole` + (G - 1)(`whole` - m): the rise that is left is G - 1 times that of
///   leaving a group out.
/// - The half width is the standard error times the quantile of Student's t of G - 1 degrees of
///   freedom.
///
/// A rise by the power p is 1 / ((G / (G - 1))^p - 1) times that of leaving a group out. With a
/// power, the interval reaches from one centre to the other, and a half width beyond both.
///
/// The rise of a percentile is known no better than the percentile. Its centre takes half of it
/// out, and its standard error is about `whole`, not m, so that it contains the rise.
pub fn jackknife_of(whole: f64, without: &[f64], rise: Rise) -> Option<Interval> {
    if without.len() < 2 {
        return None;
    }
    let count = without.len() as f64;
    // Rise of the score without each group: exactly 0 for a score that no group changes.
    let raised: Vec<f64> = without.iter().map(|value| value - whole).collect();
    let mean = raised.iter().sum::<f64>() / count;
    let (center, about) = match rise {
        Rise::Percentile(_) => (whole - 0.5 * (count - 1.0) * mean, 0.0),
        _ => (whole - (count - 1.0) * mean, mean),
    };
    let squares: f64 = raised.iter().map(|value| (value - about).powi(2)).sum();
    let standard_error = ((count - 1.0) / count * squares).sqrt();
    let half_width = standard_error * quantile(count - 1.0);
    let apart = match rise {
        Rise::Power(power) | Rise::Percentile(Some(power)) => {
            whole - mean / ((count / (count - 1.0)).powf(power) - 1.0) - center
        }
        _ => 0.0,
    };
    Some(Interval {
        low: center + apart.min(0.0) - half_width,
        high: center + apart.max(0.0) + half_width,
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
        // s = sqrt(7) over the root of 4, and the table's t for 3 degrees of freedom, 3.182: to its
        // digits.
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
        // The square of a mean is too high by the variance of the mean, and the jackknife of it is
        // unbiased.
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
        // The mean absolute error of a perfect picture, for noise of 1 in each group: its limit is
        // 0.
        let noise = |groups: f64| 1.0 / groups.sqrt();
        let interval = jackknife_of(noise(4.0), &[noise(3.0); 4], Rise::Power(0.5)).unwrap();
        assert!(interval.low.abs() < 1e-12, "{interval:?}");
        // By the inverse of the replicates, half of it would be left: the upper end.
        assert!((interval.high - 0.268).abs() < 1e-3, "{interval:?}");
        assert_eq!(interval.high, interval.center);
        let inverse = jackknife_of(noise(4.0), &[noise(3.0); 4], Rise::Inverse).unwrap();
        assert_eq!([inverse.low, inverse.high], [interval.center; 2]);
    }

    #[test]
    fn an_interval_extends_to_the_side_of_the_slower_fall_only() {
        // Noise lowers this score: SSIM of a perfect picture.
        let lowered = |groups: f64| 1.0 - 1.0 / groups.sqrt();
        let interval = jackknife_of(lowered(4.0), &[lowered(3.0); 4], Rise::Power(0.5)).unwrap();
        assert!((interval.high - 1.0).abs() < 1e-12, "{interval:?}");
        assert_eq!(interval.low, interval.center);
    }

    #[test]
    fn a_percentile_counts_its_rise_as_noise() {
        let interval = jackknife_of(1.0, &[1.1, 1.1, 1.1, 1.1], Rise::Percentile(None)).unwrap();
        // Half of 3 x 0.1 is taken out, and the root of 3 / 4 x 4 x 0.01 is the standard error.
        assert!((interval.center - 0.85).abs() < 1e-12, "{interval:?}");
        assert!((interval.standard_error - 0.03_f64.sqrt()).abs() < 1e-12);
        assert!(interval.holds(1.0) && interval.holds(0.7));
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
