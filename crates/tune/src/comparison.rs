//! Comparison of two sets of parameters on the same scenes.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use filters::Settings;
use measure::{Error, MIN_SCENES, ONE_SIDED, plain_mean};
use serde::{Deserialize, Serialize};
use tracer::Progress;

use crate::evaluator::Evaluator;
use crate::loss::log_ratio;
use crate::target::{SceneScore, SceneScores};

/// Scores of two candidates, scene by scene, and their mean differences.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairedComparison {
    /// Scores of the first and of the second, per scene.
    pub scenes: BTreeMap<String, [SceneScore; 2]>,
    /// Difference in log(FLIP): log(FLIP of the second / FLIP of the first).
    pub flip: Difference,
    /// The second's lateral bleed minus the first's, in pixels; none if it was not measured or
    /// applies to no scene.
    pub bleed: Option<Difference>,
}

/// A mean over scenes of paired differences; below 0 the second is better.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// Mean over the scenes.
    pub mean: f64,
    /// One-sided 95 % confidence limits, the lower and the upper one, by Student's t over scenes.
    #[serde(rename = "bounds")]
    pub interval: [f64; 2],
    /// Number of scenes.
    pub scenes: usize,
    /// The better one, if the interval shows it.
    pub verdict: Preference,
}

/// The better of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preference {
    /// The whole interval is above 0.
    First,
    /// The whole interval is below 0.
    Second,
    /// The interval contains 0, or there are too few scenes.
    Undecided,
}

impl Difference {
    /// Formats the mean and its interval, two one-sided limits of 95 %; a single scene has none.
    pub fn text(&self, format: impl Fn(f64) -> String) -> String {
        let mean = format(self.mean);
        let [low, high] = self.interval.map(format);
        match self.scenes {
            1 => format!("{mean} on one scene, too few for a CI"),
            scenes => format!("{mean}, 90 % CI {low} to {high}, over {scenes} scenes"),
        }
    }

    /// Averages at least one paired difference.
    pub fn new(differences: &[f64]) -> Self {
        let average = plain_mean(differences, ONE_SIDED);
        Self {
            mean: average.mean,
            interval: average.interval,
            scenes: average.scenes,
            verdict: match average.side_of_zero() {
                Some(Ordering::Greater) => Preference::First,
                Some(Ordering::Less) => Preference::Second,
                _ => Preference::Undecided,
            },
        }
    }

    /// Returns true if the second is worse by less than `margin`: the whole interval is below it.
    pub fn is_no_worse(&self, margin: f64) -> bool {
        self.scenes >= MIN_SCENES && self.interval[1] < margin
    }
}

/// Scores both on every scene of the evaluator.
pub fn compare_candidates(
    evaluator: &mut Evaluator,
    first: &Settings,
    second: &Settings,
) -> Result<PairedComparison, Error> {
    let all = evaluator.all_scenes();
    let monitor = evaluator.monitor;
    let [first, second] = monitor.watch("both sets of parameters", |watch| {
        let mut done = 0;
        let mut score = |settings: &Settings| {
            evaluator.score(settings, &all, |_, _| {
                done += 1;
                Progress::report(watch, done, 2 * all.len()).is_ok()
            })
        };
        Ok::<_, Error>([score(first)?, score(second)?])
    })?;
    Ok(PairedComparison::new(pair_scores(&first, &second)))
}

/// Pairs the scores of two candidates on their common scenes.
pub fn pair_scores(first: &SceneScores, second: &SceneScores) -> BTreeMap<String, [SceneScore; 2]> {
    (first.iter())
        .filter_map(|(scene, score)| Some((scene.clone(), [*score, *second.get(scene)?])))
        .collect()
}

impl PairedComparison {
    /// Averages the differences over at least one scene.
    pub fn new(scenes: BTreeMap<String, [SceneScore; 2]>) -> Self {
        let flip: Vec<f64> = scenes.values().map(|[a, b]| log_ratio(b, a)).collect();
        let bleed: Vec<f64> = (scenes.values())
            .filter_map(|[a, b]| Some(b.bleed? - a.bleed?))
            .collect();
        Self {
            flip: Difference::new(&flip),
            bleed: (!bleed.is_empty()).then(|| Difference::new(&bleed)),
            scenes,
        }
    }
}
