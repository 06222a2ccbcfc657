//! Morris screening: which parameters matter at all.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::random::Random;

/// Levels of each coordinate, an even number.
const LEVELS: usize = 4;
/// How far a coordinate steps: with this length every level is met equally often.
const STEP: f64 = LEVELS as f64 / (2 * (LEVELS - 1)) as f64;

/// Elementary effects of one axis: changes of the function per length of the cube.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElementaryEffects {
    /// Their mean.
    pub mean: f64,
    /// Mean of their sizes: how much the axis matters (Campolongo, Cariboni and Saltelli 2007).
    pub mean_size: f64,
    /// Their standard deviation: how much that depends on the other axes, or on where one is.
    pub deviation: f64,
}

impl ElementaryEffects {
    /// Half the width of the 95 % interval of `mean_size`, by Student's t over the trajectories; 0 of fewer than two.
    pub fn half_width(&self, trajectories: usize) -> f64 {
        if trajectories < 2 {
            return 0.0;
        }
        let count = trajectories as f64;
        let squares = (count - 1.0) / count * self.deviation.powi(2) + self.mean.powi(2);
        let variance = (squares - self.mean_size.powi(2)).max(0.0) / (count - 1.0);
        let student = StudentsT::new(0.0, 1.0, count - 1.0).expect("two have a degree of freedom");
        variance.sqrt() * student.inverse_cdf(0.975)
    }
}

/// Walks through the cube's grid `trajectories` times, one step along each axis in an order by chance, and so asks
/// `trajectories` x (`axes` + 1) times (Morris, "Factorial Sampling Plans for Preliminary Computational Experiments",
/// Technometrics 33, 1991). At least two trajectories.
pub fn morris<E>(
    axes: usize,
    trajectories: usize,
    seed: u64,
    mut function: impl FnMut(&[f64]) -> Result<f64, E>,
) -> Result<Vec<ElementaryEffects>, E> {
    assert!(trajectories >= 2, "one trajectory has no spread");
    let mut random = Random(seed);
    let mut effects = vec![Vec::new(); axes];
    for _ in 0..trajectories {
        let mut point: Vec<f64> = (0..axes)
            .map(|_| random.below(LEVELS) as f64 / (LEVELS - 1) as f64)
            .collect();
        let mut order: Vec<usize> = (0..axes).collect();
        for last in (1..axes).rev() {
            order.swap(last, random.below(last + 1));
        }
        let mut before = function(&point)?;
        for axis in order {
            let step = if point[axis] < 0.5 { STEP } else { -STEP };
            point[axis] += step;
            let after = function(&point)?;
            effects[axis].push((after - before) / step);
            before = after;
        }
    }
    Ok(effects.iter().map(|effects| pooled(effects)).collect())
}

fn pooled(effects: &[f64]) -> ElementaryEffects {
    let count = effects.len() as f64;
    let mean = effects.iter().sum::<f64>() / count;
    let squares: f64 = effects.iter().map(|it| (it - mean).powi(2)).sum();
    ElementaryEffects {
        mean,
        mean_size: effects.iter().map(|it| it.abs()).sum::<f64>() / count,
        deviation: (squares / (count - 1.0)).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_effects_is_that_of_their_sizes() {
        // Sizes 1, 2, 3, 2: mean 2, variance 2/3, standard error 0.408; t of 3 degrees of freedom is 3.182.
        let found = pooled(&[1.0, -2.0, 3.0, -2.0]);
        assert_eq!(found.mean_size, 2.0);
        assert!(
            (found.half_width(4) - 3.182 * 0.408_25).abs() < 1e-3,
            "{found:?}"
        );
        assert_eq!(found.half_width(0), 0.0);
    }
}
