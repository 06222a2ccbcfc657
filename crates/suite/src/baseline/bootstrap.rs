//! How far the mean over scenes may be off because other scenes could have been taken.

/// Samples of scenes.
const SAMPLES: usize = 2000;
/// Of the samples' means so many lie below the lower bound, and as many above the upper one.
const TAIL: f64 = 0.05;

/// One-sided 95 % bounds, the lower and the upper one, of the mean of at least one value: percentiles of the means of samples
/// with replacement (Efron and Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13). The same values have the
/// same bounds; a single value is both.
pub fn bootstrap(values: &[f64]) -> [f64; 2] {
    assert!(!values.is_empty(), "a mean is of at least one value");
    let mut random = Random(1);
    let mut means: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let drawn = (0..values.len()).map(|_| values[random.below(values.len())]);
            drawn.sum::<f64>() / values.len() as f64
        })
        .collect();
    means.sort_unstable_by(f64::total_cmp);
    let last = (SAMPLES - 1) as f64;
    [TAIL, 1.0 - TAIL].map(|part| means[(part * last).round() as usize])
}

/// SplitMix64 (Steele, Lea and Flood 2014): small, and the same in every version.
struct Random(u64);

impl Random {
    /// A number below `count`.
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        ((u128::from(bits) * count as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_is_its_own_bounds() {
        assert_eq!(bootstrap(&[0.25]), [0.25, 0.25]);
        assert_eq!(bootstrap(&[0.25; 5]), [0.25, 0.25]);
    }

    #[test]
    fn bounds_are_those_of_the_normal_distribution_where_values_are_many() {
        // 0, 1 .. 99: mean 49.5, standard deviation 28.87 (of the whole), standard error of the mean 2.887.
        let values: Vec<f64> = (0..100).map(f64::from).collect();
        let [low, high] = bootstrap(&values);
        // 1.645 standard errors, within 4 times the scatter of a 5 % percentile of 2000 samples, 0.047 standard errors.
        let tolerance = 4.0 * 0.047 * 2.887;
        assert!((low - (49.5 - 1.645 * 2.887)).abs() < tolerance, "{low}");
        assert!((high - (49.5 + 1.645 * 2.887)).abs() < tolerance, "{high}");
    }
}
