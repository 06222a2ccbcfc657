//! Means and percentiles.

use frame::{Raster, Region, Regions};

/// Averages values; `None` if there are none.
pub(crate) fn mean(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_u32);
    for value in values {
        sum += value;
        count += 1;
    }
    (count > 0).then(|| sum / f64::from(count))
}

/// Averages the values of a map over a region; `None` if that is empty.
pub(crate) fn mean_over<T: Copy + Into<f64>>(
    map: &Raster<T>,
    regions: &Regions,
    region: Region,
) -> Option<f64> {
    mean(regions.indices(region).map(|at| map.pixels[at].into()))
}

/// Finds the value that at least this part of the sorted values does not exceed (nearest rank);
/// `None` if there are none.
pub(crate) fn percentile(sorted: &[f32], part: f64) -> Option<f64> {
    sorted
        .get(find_rank(sorted.len(), part)?)
        .map(|value| f64::from(*value))
}

/// Finds the same of values in any order, in linear time.
pub(crate) fn percentile_of(mut values: Vec<f64>, part: f64) -> Option<f64> {
    let rank = find_rank(values.len(), part)?;
    let (_, value, _) = values.select_nth_unstable_by(rank, f64::total_cmp);
    Some(*value)
}

/// Returns the place among the sorted values, counted from 0; `None` if there are none.
fn find_rank(count: usize, part: f64) -> Option<usize> {
    ((count as f64 * part).ceil() as usize).checked_sub(1)
}

/// Finds the smallest of the sorted values up to which they add up to half of their sum, as the
/// FLIP tool reports it: pixels without error do not count. Values are not negative; `None` if
/// there are none.
pub(crate) fn weighted_median(sorted: &[f32]) -> Option<f64> {
    let values = || sorted.iter().map(|value| f64::from(*value));
    let half = 0.5 * values().sum::<f64>();
    let mut sum = 0.0;
    values().find(|value| {
        sum += value;
        sum >= half
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_percentile_is_the_value_that_95_percent_do_not_exceed() {
        let values: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        let sorted: Vec<f32> = (1..=100_u8).map(f32::from).collect();
        for (part, expected) in [(0.95, 95.0), (0.99, 99.0)] {
            assert_eq!(percentile(&sorted, part), Some(expected));
            assert_eq!(percentile_of(values.clone(), part), Some(expected));
        }
        assert_eq!(percentile(&sorted[90..], 0.95), Some(100.0));
        assert_eq!(percentile(&[3.0], 0.95), Some(3.0));
        assert_eq!(percentile(&[], 0.95), None);
        assert_eq!(percentile_of(Vec::new(), 0.95), None);
        assert_eq!(mean([]), None);
    }

    #[test]
    fn half_of_the_error_lies_below_the_weighted_median() {
        // 1 + 2 + 3 + 4 = 10: the 3 passes 5.
        let sorted = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0];
        assert_eq!(weighted_median(&sorted), Some(3.0));
        assert_eq!(weighted_median(&[0.0, 0.0]), Some(0.0));
        assert_eq!(weighted_median(&[]), None);
    }
}
