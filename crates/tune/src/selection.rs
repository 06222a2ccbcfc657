//! Selection of the trial that becomes the choice.

use std::collections::{BTreeMap, BTreeSet};

use filters::Settings;
use serde::{Deserialize, Serialize};

use crate::loss::{log_ratios, mean_log_ratio};
use crate::space::Space;
use crate::trial::Trial;

/// Upper limits on the choice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChoiceLimits {
    /// GPU time relative to the start's.
    pub cost: Option<f64>,
    /// Lateral bleed of the worst scene, in pixels.
    pub bleed: Option<f64>,
}

impl ChoiceLimits {
    /// Returns true if a trial ran on every scene and keeps the limits.
    pub fn allow(&self, trial: &Trial) -> bool {
        let holds = |value: Option<f64>, limit: Option<f64>| match limit {
            Some(limit) => value.is_some_and(|value| value <= limit),
            None => true,
        };
        // The limits are relative to the start, so noise of the clock must not exclude it.
        let is_start = trial.trial == 0;
        trial.is_done()
            && (is_start || holds(trial.cost, self.cost) && holds(trial.bleed, self.bleed))
    }
}

/// Trial selected by the one-standard-error rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Number of the chosen trial.
    pub trial: usize,
    /// Number of the trial with the smallest error.
    pub best: usize,
    /// Standard error of the best one's mean over scenes of log(error / error of the start).
    pub standard_error: f64,
}

/// Chooses among the trials that keep the limits, by their means over the scenes that `counts` selects: the trial nearest to the start
/// among all within one standard error of the best. So the start wins if the scenes cannot decide (Breiman, Friedman, Olshen and Stone,
/// "Classification and Regression Trees", 1984, section 3.4.3). None if no scene counts.
pub fn choose_trial(
    trials: &[Trial],
    space: &Space,
    limits: ChoiceLimits,
    counts: impl Fn(&str) -> bool,
) -> Option<Choice> {
    let start = &trials.first()?.scenes;
    let allowed: Vec<(&Trial, f64)> = (trials.iter())
        .filter(|trial| limits.allow(trial))
        .map(|trial| Some((trial, mean_log_ratio(&trial.scenes, start, &counts)?)))
        .collect::<Option<_>>()?;
    let (best, least) = (allowed.iter().copied()).min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let standard_error = standard_error_of_mean(&log_ratios(&best.scenes, start, &counts));
    let distance = |trial: &Trial| space.distance(&trial_settings(space, trial), &space.start);
    let (chosen, _) = (allowed.iter())
        .filter(|(_, error)| *error <= least + standard_error)
        .min_by(|(a, a_error), (b, b_error)| {
            let nearer = distance(a).total_cmp(&distance(b));
            nearer.then(a_error.total_cmp(b_error))
        })?;
    Some(Choice {
        trial: chosen.trial,
        best: best.trial,
        standard_error,
    })
}

/// Adds the values that all trials share to one trial's.
pub fn trial_settings(space: &Space, trial: &Trial) -> Settings {
    let mut settings = space.start.clone();
    settings.values.extend(trial.values.clone());
    settings
}

/// Returns the standard error of the mean of scenes' log ratios; 0 for a single scene, which says nothing about others.
fn standard_error_of_mean(ratios: &[f64]) -> f64 {
    if ratios.len() < 2 {
        return 0.0;
    }
    let count = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let squares: f64 = ratios.iter().map(|it| (it - mean).powi(2)).sum();
    (squares / (count - 1.0) / count).sqrt()
}

/// Result on one family of scenes of a choice made without it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Family left out.
    pub family: String,
    /// Number of its scenes.
    pub scenes: usize,
    /// Trial chosen by the other families.
    pub trial: usize,
    /// The trial's mean log(error / error of the start) on the others.
    pub others: f64,
    /// The trial's mean on the family left out.
    pub held_out: f64,
    /// `held_out - others`: above 0, the choice is worse on the family left out.
    pub gap: f64,
}

/// Leaves each family out of the choice in turn; returns nothing for a single family. The search for trials used all scenes: folds show
/// how much the choice among them overfits, and held-out scenes show it for the search as well.
pub fn cross_validate(
    trials: &[Trial],
    space: &Space,
    limits: ChoiceLimits,
    families: &BTreeMap<&str, Vec<String>>,
) -> Vec<Fold> {
    if families.len() < 2 {
        return Vec::new();
    }
    let fold = |(family, scenes): (&&str, &Vec<String>)| {
        let held: BTreeSet<&str> = scenes.iter().map(String::as_str).collect();
        let choice = choose_trial(trials, space, limits, |scene| !held.contains(scene))?;
        let start = &trials[0].scenes;
        let chosen = &trials[choice.trial].scenes;
        let others = mean_log_ratio(chosen, start, |scene| !held.contains(scene))?;
        let held_out = mean_log_ratio(chosen, start, |scene| held.contains(scene))?;
        Some(Fold {
            family: family.to_string(),
            scenes: scenes.len(),
            trial: choice.trial,
            others,
            held_out,
            gap: held_out - others,
        })
    };
    families.iter().filter_map(fold).collect()
}
