//! Means and percentiles.

/// Averages values; `None` if there are none.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Finds the value that at least this part of the sorted values does not exceed (nearest rank); `None` if there are none.
pub(crate) fn percentile(sorted: &[f64], part: f64) -> Option<f64> {
    let rank = (sorted.len() as f64 * part).ceil() as usize;
    sorted.get(rank.checked_sub(1)?).copied()
}

/// Finds the smallest of the sorted values up to which they add up to half of their sum, as the FLIP tool reports it: pixels
/// without error do not count. Values are not negative; `None` if there are none.
pub(crate) fn weighted_median(sorted: &[f64]) -> Option<f64> {
    let half = 0.5 * sorted.iter().sum::<f64>();
    let mut sum = 0.0;
    sorted.iter().copied().find(|value| {
        sum += value;
        sum >= half
    })
}

/// Sorts values in rising order.
pub(crate) fn sort(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentile_is_the_value_that_95_percent_do_not_exceed() {
        let values = sort((1..=100).rev().map(f64::from).collect());
        assert_eq!(percentile(&values, 0.95), Some(95.0));
        assert_eq!(percentile(&values[90..], 0.95), Some(100.0));
        assert_eq!(percentile(&[3.0], 0.95), Some(3.0));
        assert_eq!(percentile(&[], 0.95), None);
        assert_eq!(percentile(&values, 0.99), Some(99.0));
        assert_eq!(mean(&[]), None);
    }

    #[test]
    fn half_of_the_error_lies_below_the_weighted_median() {
        // 1 + 2 + 3 + 4 = 10: the 3 passes 5.
        assert_eq!(
            weighted_median(&sort(vec![4.0, 0.0, 2.0, 0.0, 3.0, 0.0, 1.0])),
            Some(3.0)
        );
        assert_eq!(weighted_median(&[0.0, 0.0]), Some(0.0));
        assert_eq!(weighted_median(&[]), None);
    }
}
