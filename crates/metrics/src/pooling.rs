//! One number from many.

/// The mean of values; `None` of none.
pub(crate) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The value that at least 95 % of the values do not exceed (nearest rank); `None` of none.
pub(crate) fn percentile_95(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let rank = (sorted.len() as f64 * 0.95).ceil() as usize;
    sorted.get(rank.checked_sub(1)?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentile_is_the_value_that_95_percent_do_not_exceed() {
        let values: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        assert_eq!(percentile_95(&values), Some(95.0));
        assert_eq!(percentile_95(&values[..10]), Some(100.0));
        assert_eq!(percentile_95(&[3.0]), Some(3.0));
        assert_eq!(percentile_95(&[]), None);
        assert_eq!(mean(&[]), None);
    }
}
