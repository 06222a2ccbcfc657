//! Two sets of parameters on the same scenes.

use std::collections::BTreeMap;

use filters::Settings;
use serde::{Deserialize, Serialize};

use super::loss::log_ratio;
use super::{Evaluator, SceneScore};
use crate::Error;
use crate::stats::scene_mean::plain_mean;

/// Scores of two candidates, scene by scene, and what they come to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Paired {
    /// Per scene, those of the first and those of the second.
    pub scenes: BTreeMap<String, [SceneScore; 2]>,
    /// Of log(FLIP of the second / FLIP of the first).
    pub flip: Difference,
    /// The second's lateral bleed minus the first's, in pixels; none where it was not measured or applies to no scene.
    pub bleed: Option<Difference>,
}

/// A mean over scenes of paired differences; below 0 the second is better.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// Over the scenes.
    pub mean: f64,
    /// One-sided 95 % bounds, the lower and the upper one, by Student's t over scenes.
    pub bounds: [f64; 2],
    /// How many scenes.
    pub scenes: usize,
    /// What the bounds say.
    pub verdict: Preference,
}

/// Which of two is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preference {
    /// Both bounds are above 0.
    First,
    /// Both bounds are below 0.
    Second,
    /// They have 0 between them.
    Undecided,
}

/// So likely lies the mean below the lower bound, and so likely above the upper one.
const TAIL: f64 = 0.05;

/// Fewer scenes than this decide nothing: with four, all of one sign are met by chance once in eight times.
pub const FEWEST_SCENES: usize = 5;

impl Difference {
    /// Whether the second is no worse than the first by more than `margin`: the upper bound lies below it.
    pub fn is_no_worse(&self, margin: f64) -> bool {
        self.scenes >= FEWEST_SCENES && self.bounds[1] < margin
    }

    /// Of at least one paired difference.
    pub fn of(differences: &[f64]) -> Self {
        let found = plain_mean(differences, TAIL);
        let verdict = match found.interval {
            _ if differences.len() < FEWEST_SCENES => Preference::Undecided,
            [low, _] if low > 0.0 => Preference::First,
            [_, high] if high < 0.0 => Preference::Second,
            _ => Preference::Undecided,
        };
        Self {
            mean: found.mean,
            bounds: found.interval,
            scenes: differences.len(),
            verdict,
        }
    }
}

/// Runs both on every scene of the evaluator.
pub fn compare_paired(
    evaluator: &mut Evaluator,
    first: &Settings,
    second: &Settings,
) -> Result<Paired, Error> {
    let all: Vec<usize> = (0..evaluator.targets.len()).collect();
    let first = evaluator.scores(first, &all, |_, _| true)?;
    let second = evaluator.scores(second, &all, |_, _| true)?;
    let names = evaluator.targets.iter().map(|it| it.shot.name.clone());
    let pairs = first.into_iter().zip(second).map(|(a, b)| [a, b]);
    Ok(Paired::of(names.zip(pairs).collect()))
}

impl Paired {
    /// Of at least one scene.
    pub fn of(scenes: BTreeMap<String, [SceneScore; 2]>) -> Self {
        let flip: Vec<f64> = scenes.values().map(|[a, b]| log_ratio(b, a)).collect();
        let bleed: Vec<f64> = (scenes.values())
            .filter_map(|[a, b]| Some(b.bleed? - a.bleed?))
            .collect();
        Self {
            flip: Difference::of(&flip),
            bleed: (!bleed.is_empty()).then(|| Difference::of(&bleed)),
            scenes,
        }
    }
}
