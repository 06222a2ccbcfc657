//! How far the mean over scenes may be off because other scenes could have been taken, and because the truths are noisy.

/// Samples of scenes.
const SAMPLES: usize = 2000;

/// The lower and the upper bound of the mean of at least one value, beyond each of which it lies with a probability of `tail`:
/// percentiles of the means of samples with replacement (Efron and Tibshirani, "An Introduction to the Bootstrap", 1993,
/// chapter 13). The same values have the same bounds; a single value is both.
pub fn bootstrap(values: &[f64], tail: f64) -> [f64; 2] {
    let exact: Vec<[f64; 2]> = values.iter().map(|value| [*value, 0.0]).collect();
    bootstrap_noisy(&exact, tail)
}

/// The same of values that come with their standard errors: each time that one is drawn it is off by a normal deviate.
pub fn bootstrap_noisy(values: &[[f64; 2]], tail: f64) -> [f64; 2] {
    assert!(!values.is_empty(), "a mean is of at least one value");
    let mut random = Random(1);
    let mut means: Vec<f64> = (0..SAMPLES)
        .map(|_| {
            let drawn = (0..values.len()).map(|_| {
                let [value, error] = values[random.below(values.len())];
                match error {
                    0.0 => value,
                    _ => value + error * random.normal(),
                }
            });
            drawn.sum::<f64>() / values.len() as f64
        })
        .collect();
    means.sort_unstable_by(f64::total_cmp);
    let last = (SAMPLES - 1) as f64;
    [tail, 1.0 - tail].map(|part| means[(part * last).round() as usize])
}

/// SplitMix64 (Steele, Lea and Flood 2014): small, and the same in every version.
pub(crate) struct Random(pub u64);

impl Random {
    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// Of mean 0 and variance 1 (Box and Muller 1958).
    fn normal(&mut self) -> f64 {
        // From above 0 to 1, and from 0 to below 1.
        let [radius, turn] =
            [1.0, 0.0].map(|least| ((self.bits() >> 11) as f64 + least) / (1u64 << 53) as f64);
        (-2.0 * radius.ln()).sqrt() * (std::f64::consts::TAU * turn).cos()
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_is_its_own_bounds() {
        assert_eq!(bootstrap(&[0.25], 0.05), [0.25, 0.25]);
        assert_eq!(bootstrap(&[0.25; 5], 0.05), [0.25, 0.25]);
    }

    #[test]
    fn bounds_are_those_of_the_normal_distribution_where_values_are_many() {
        // 0, 1 .. 99: mean 49.5, standard deviation 28.87 (of the whole), standard error of the mean 2.887.
        let values: Vec<f64> = (0..100).map(f64::from).collect();
        let [low, high] = bootstrap(&values, 0.05);
        // 1.645 standard errors, within 4 times the scatter of a 5 % percentile of 2000 samples, 0.047 standard errors.
        let tolerance = 4.0 * 0.047 * 2.887;
        assert!((low - (49.5 - 1.645 * 2.887)).abs() < tolerance, "{low}");
        assert!((high - (49.5 + 1.645 * 2.887)).abs() < tolerance, "{high}");
    }

    #[test]
    fn noise_of_the_values_widens_the_bounds() {
        // The same value 25 times, each off by a standard error of 1: the mean's is 0.2.
        let [low, high] = bootstrap_noisy(&[[3.0, 1.0]; 25], 0.05);
        let tolerance = 4.0 * 0.047 * 0.2;
        assert!((low - (3.0 - 1.645 * 0.2)).abs() < tolerance, "{low}");
        assert!((high - (3.0 + 1.645 * 0.2)).abs() < tolerance, "{high}");
    }
}
