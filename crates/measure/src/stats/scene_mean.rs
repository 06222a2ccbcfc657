//! Mean of a score over scenes, with a confidence interval over all similar scenes.

use std::cmp::Ordering;

use statrs::distribution::{ContinuousCDF, StudentsT};

/// Probability that the mean over all such scenes is below a two-sided 95 % interval; the same for
/// above.
pub const TWO_SIDED: f64 = 0.025;
/// Probability that the mean over all such scenes is beyond either one-sided 95 % limit.
pub const ONE_SIDED: f64 = 0.05;
/// Smallest number of scenes that decides anything: four differences all have one sign by chance
/// once in eight times.
pub const MIN_SCENES: usize = 5;

/// A score on one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// Score in the metric's unit.
    pub value: f64,
    /// Weight of the scene, above 0: 1, or for a ratio of means the ratio's denominator.
    pub weight: f64,
}

impl Weighted {
    /// Makes a score of weight 1.
    pub fn plain(value: f64) -> Self {
        Self { value, weight: 1.0 }
    }
}

/// A mean over scenes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneMean {
    /// Weighted mean.
    pub mean: f64,
    /// Its lower and upper confidence limit.
    pub interval: [f64; 2],
    /// Number of scenes.
    pub scenes: usize,
}

impl SceneMean {
    /// Returns the side of 0 that contains the whole interval; none if the interval contains 0, or
    /// the scenes are too few to decide.
    pub fn side_of_zero(&self) -> Option<Ordering> {
        match self.interval {
            _ if self.scenes < MIN_SCENES => None,
            [low, _] if low > 0.0 => Some(Ordering::Greater),
            [_, high] if high < 0.0 => Some(Ordering::Less),
            _ => None,
        }
    }
}

/// Averages at least one scene. The mean over all such scenes is beyond either end of the interval
/// with a probability of `tail`, by Student's t of the scenes' weighted deviations. For equal
/// weights this is the textbook interval of a mean; otherwise it is the linearised interval of a
/// ratio of means (Cochran, "Sampling Techniques", 1977, section 6.4). The interval of one scene
/// has no width.
///
/// The interval includes the truths' noise, which makes scores deviate just as scenes do. Adding
/// each score's standard error would count the noise twice.
pub fn scene_mean(scores: &[Weighted], tail: f64) -> SceneMean {
    assert!(!scores.is_empty(), "a mean is of at least one value");
    let count = scores.len() as f64;
    let weight = scores.iter().map(|score| score.weight).sum::<f64>() / count;
    let weighted = |score: &Weighted| score.weight * score.value;
    let mean = scores.iter().map(weighted).sum::<f64>() / (count * weight);
    if scores.len() == 1 {
        return SceneMean {
            mean,
            interval: [mean; 2],
            scenes: 1,
        };
    }
    let deviation = |score: &Weighted| score.weight / weight * (score.value - mean);
    let squares: f64 = scores.iter().map(|score| deviation(score).powi(2)).sum();
    let standard_error = (squares / (count * (count - 1.0))).sqrt();
    let student = StudentsT::new(0.0, 1.0, count - 1.0).expect("two have a degree of freedom");
    let half_width = student.inverse_cdf(1.0 - tail) * standard_error;
    SceneMean {
        mean,
        interval: [mean - half_width, mean + half_width],
        scenes: scores.len(),
    }
}

/// Averages scores of equal weight.
pub fn plain_mean(values: &[f64], tail: f64) -> SceneMean {
    let scores: Vec<Weighted> = values.iter().copied().map(Weighted::plain).collect();
    scene_mean(&scores, tail)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn the_interval_of_one_value_has_no_width() {
        assert_eq!(plain_mean(&[0.25], 0.05).interval, [0.25, 0.25]);
        assert_eq!(plain_mean(&[0.25; 5], 0.05).interval, [0.25, 0.25]);
    }

    #[test]
    fn intervals_are_the_textbooks() {
        // s = sqrt(7) over the root of 4, and the table's t for 3 degrees of freedom: 3.182, or
        // 2.353 on one side; to its digits.
        let error = 7f64.sqrt() / 2.0;
        for (tail, quantile) in [(0.025, 3.182), (0.05, 2.353)] {
            let average = plain_mean(&[1.0, 2.0, 4.0, 7.0], tail);
            assert_eq!(average.mean, 3.5);
            let [low, high] = average.interval;
            assert!((low - (3.5 - quantile * error)).abs() < 1e-3, "{average:?}");
            assert!(
                (high - (3.5 + quantile * error)).abs() < 1e-3,
                "{average:?}"
            );
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
        let average = scene_mean(&scores, 0.025);
        let ratio = gained.iter().sum::<f64>() / way.iter().sum::<f64>();
        assert!((average.mean - ratio).abs() < 1e-12, "{average:?}");
        // 4.303 is the table's t for 2 degrees of freedom; the residuals are gained - ratio x way
        // over the mean way.
        let mean_way = way.iter().sum::<f64>() / 3.0;
        let squares: f64 = (gained.iter().zip(way))
            .map(|(gained, way)| ((gained - ratio * way) / mean_way).powi(2))
            .sum();
        let half = 4.303 * (squares / 6.0).sqrt();
        assert!(
            (average.interval[1] - ratio - half).abs() < 1e-3,
            "{average:?}"
        );
    }

    /// FLIP of three filters on the 23 shipped scenes at 160x90, by 32 samples per pixel: skewed,
    /// with one far outlier.
    const FLIP: [[f64; 23]; 3] = [
        // mcguire:paper
        [
            0.050, 0.035, 0.053, 0.056, 0.149, 0.072, 0.057, 0.0, 0.074, 0.079, 0.066, 0.051,
            0.044, 0.139, 0.058, 0.055, 0.050, 0.069, 0.069, 0.089, 0.076, 0.060, 0.051,
        ],
        // bevy:high
        [
            0.056, 0.035, 0.049, 0.059, 0.162, 0.076, 0.057, 0.0, 0.072, 0.093, 0.053, 0.059,
            0.040, 0.168, 0.059, 0.045, 0.054, 0.050, 0.083, 0.107, 0.088, 0.054, 0.065,
        ],
        // kino:default
        [
            0.046, 0.035, 0.052, 0.052, 0.124, 0.079, 0.057, 0.0, 0.077, 0.091, 0.094, 0.046,
            0.066, 0.112, 0.066, 0.071, 0.051, 0.169, 0.084, 0.084, 0.070, 0.050, 0.052,
        ],
    ];
    /// Excess FLIP of doing nothing over jump_flood:paper, and over the one-frame oracle.
    const GAINED: [[f64; 2]; 18] = [
        [0.035, 0.042],
        [0.041, 0.060],
        [0.129, 0.240],
        [0.072, 0.056],
        [0.053, 0.041],
        [0.080, 0.104],
        [0.127, 0.149],
        [0.106, 0.131],
        [0.017, 0.054],
        [0.138, 0.175],
        [0.182, 0.324],
        [0.039, 0.063],
        [0.066, 0.051],
        [0.212, 0.300],
        [0.107, 0.218],
        [0.259, 0.295],
        [0.025, 0.094],
        [0.022, 0.066],
    ];

    /// Returns the share of 10,000 intervals over `scenes` samples of a population that contain the
    /// population's mean.
    fn coverage(population: &[Weighted], scenes: usize) -> f64 {
        let mut random = Random(1);
        let expected = scene_mean(population, 0.025).mean;
        let holds = (0..10_000).filter(|_| {
            let sample: Vec<Weighted> = (0..scenes)
                .map(|_| population[random.below(population.len())])
                .collect();
            let [low, high] = scene_mean(&sample, 0.025).interval;
            (low..=high).contains(&expected)
        });
        holds.count() as f64 / 10_000.0
    }

    #[test]
    fn of_100_intervals_over_5_skewed_scenes_90_hold_the_mean_and_over_23_scenes_92() {
        for (scenes, least) in [(5, 0.90), (23, 0.92)] {
            let all = FLIP.map(|scores| coverage(&scores.map(Weighted::plain), scenes));
            // Measured 0.92 and 0.93. The standard error of the three is 0.002.
            let share = all.iter().sum::<f64>() / 3.0;
            assert!(share > least, "{scenes} scenes: {share}");
        }
    }

    #[test]
    fn intervals_of_ratios_of_means_hold_the_ratio() {
        let population = GAINED.map(|[gained, way]| Weighted {
            value: gained / way,
            weight: way,
        });
        for scenes in [5, 23] {
            let share = coverage(&population, scenes);
            assert!(share > 0.91, "{scenes} scenes: {share}");
        }
    }
}
