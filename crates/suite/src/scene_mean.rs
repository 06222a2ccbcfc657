//! The mean of a score over scenes, and how far it may be off because other scenes could have been taken.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A score on one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// In the metric's unit.
    pub value: f64,
    /// How much the scene counts, above 0: 1, or for a ratio of means what its ratio is divided by.
    pub weight: f64,
}

impl Weighted {
    /// A score that counts as much as any other.
    pub fn plain(value: f64) -> Self {
        Self { value, weight: 1.0 }
    }
}

/// A mean over scenes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneMean {
    /// Weighted mean.
    pub mean: f64,
    /// The lower and the upper bound, beyond each of which the mean over all such scenes lies with the wanted probability.
    pub bounds: [f64; 2],
}

/// The weighted mean of at least one scene, with bounds beyond each of which the mean over all such scenes lies with a
/// probability of `tail`: Student's t of the scenes' weighted deviations. For equal weights that is the textbook's interval of
/// a mean. For others it is that of a ratio of means, linearised (Cochran, "Sampling Techniques", 1977, section 6.4). One
/// scene is its own bounds.
///
/// The truths' noise is in it: it makes the scenes' scores deviate, beside what the scenes themselves do. A standard error of
/// each score, added to that, would count it twice.
pub fn scene_mean(scores: &[Weighted], tail: f64) -> SceneMean {
    assert!(!scores.is_empty(), "a mean is of at least one value");
    let count = scores.len() as f64;
    let weight = scores.iter().map(|score| score.weight).sum::<f64>() / count;
    let weighted = |score: &Weighted| score.weight * score.value;
    let mean = scores.iter().map(weighted).sum::<f64>() / (count * weight);
    if scores.len() == 1 {
        return SceneMean {
            mean,
            bounds: [mean; 2],
        };
    }
    let deviation = |score: &Weighted| score.weight / weight * (score.value - mean);
    let squares: f64 = scores.iter().map(|score| deviation(score).powi(2)).sum();
    let standard_error = (squares / (count * (count - 1.0))).sqrt();
    let student = StudentsT::new(0.0, 1.0, count - 1.0).expect("two have a degree of freedom");
    let half_width = student.inverse_cdf(1.0 - tail) * standard_error;
    SceneMean {
        mean,
        bounds: [mean - half_width, mean + half_width],
    }
}

/// The same of scores that count alike.
pub fn plain_mean(values: &[f64], tail: f64) -> SceneMean {
    let scores: Vec<Weighted> = values.iter().copied().map(Weighted::plain).collect();
    scene_mean(&scores, tail)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_value_is_its_own_bounds() {
        assert_eq!(plain_mean(&[0.25], 0.05).bounds, [0.25, 0.25]);
        assert_eq!(plain_mean(&[0.25; 5], 0.05).bounds, [0.25, 0.25]);
    }

    #[test]
    fn bounds_are_the_textbooks() {
        // s = sqrt(7) over the root of 4, and the table's t for 3 degrees of freedom: 3.182, or 2.353 on one side; to its digits.
        let error = 7f64.sqrt() / 2.0;
        for (tail, quantile) in [(0.025, 3.182), (0.05, 2.353)] {
            let found = plain_mean(&[1.0, 2.0, 4.0, 7.0], tail);
            assert_eq!(found.mean, 3.5);
            let [low, high] = found.bounds;
            assert!((low - (3.5 - quantile * error)).abs() < 1e-3, "{found:?}");
            assert!((high - (3.5 + quantile * error)).abs() < 1e-3, "{found:?}");
        }
    }

    #[test]
    fn a_weighted_mean_of_ratios_is_the_ratio_of_the_means() {
        let [gained, way] = [[0.1, 0.3, 0.02], [0.2, 0.5, 0.01]];
        let scores: Vec<Weighted> = (gained.iter().zip(way))
            .map(|(gained, weight)| Weighted {
                value: gained / weight,
                weight,
            })
            .collect();
        let found = scene_mean(&scores, 0.025);
        let ratio = gained.iter().sum::<f64>() / way.iter().sum::<f64>();
        assert!((found.mean - ratio).abs() < 1e-12, "{found:?}");
        // 4.303 is the table's t for 2 degrees of freedom; the residuals are gained - ratio x way over the mean way.
        let mean_way = way.iter().sum::<f64>() / 3.0;
        let squares: f64 = (gained.iter().zip(way))
            .map(|(gained, way)| ((gained - ratio * way) / mean_way).powi(2))
            .sum();
        let half = 4.303 * (squares / 6.0).sqrt();
        assert!((found.bounds[1] - ratio - half).abs() < 1e-3, "{found:?}");
    }
}
