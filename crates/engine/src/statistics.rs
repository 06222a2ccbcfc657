//! Medians and percentiles.

/// Returns the median; NaN without values. Ignores values that are not finite.
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    percentile(&values, 0.5).unwrap_or(f64::NAN)
}

/// Returns the value that a part of some sorted values is below; none without values.
pub fn percentile(sorted: &[f64], part: f64) -> Option<f64> {
    let last = sorted.len().saturating_sub(1) as f64;
    sorted.get((part * last).round() as usize).copied()
}
