//! Selection of the trial that becomes the choice.

use std::collections::{BTreeMap, BTreeSet};

use filters::Settings;
use serde::{Deserialize, Serialize};

use crate::loss::{log_ratios, mean_log_ratio};
use crate::space::Space;
use crate::trial::Trial;

/// Largest mean log(error / error of the best) that a choice may have: an error 1 % larger, which
/// few tables show.
const LARGEST_LOSS: f64 = 0.01;

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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Number of the chosen trial.
    pub trial: usize,
    /// Number of the trial with the smallest error.
    pub best: usize,
    /// Distance of the choice from the best.
    pub loss: Loss,
    /// Parameters of the chosen trial that were set back to the start afterwards: the scenes do not
    /// show their effect.
    pub reset: Vec<String>,
}

/// Mean over scenes of log(error / error of the best).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loss {
    /// Mean; above 0 if the best is better.
    pub mean: f64,
    /// Standard error of the mean, from the differences scene by scene; 0 for a single scene, which
    /// says nothing about others.
    pub standard_error: f64,
}

impl Loss {
    /// Compares a trial with the best on the scenes that `counts` selects, of which there is at
    /// least one.
    pub fn new(trial: &Trial, best: &Trial, counts: impl Fn(&str) -> bool) -> Self {
        let ratios = log_ratios(&trial.scenes, &best.scenes, counts);
        let count = ratios.len() as f64;
        let mean = ratios.iter().sum::<f64>() / count;
        let squares: f64 = ratios.iter().map(|ratio| (ratio - mean).powi(2)).sum();
        Self {
            mean,
            standard_error: match ratios.len() {
                1 => 0.0,
                _ => (squares / (count - 1.0) / count).sqrt(),
            },
        }
    }

    /// Returns true if the scenes do not tell the trial from the best: its loss is within one
    /// standard error of 0.
    ///
    /// A trial that is worse on all of several scenes never is: the mean of numbers above 0 exceeds
    /// its standard error. Among equals, a loss is beyond one standard error about as often on few
    /// scenes as on many (25 % of the time on two, 18 % on six, 16 % on hundreds, by Student's t).
    /// A test at 5 % would let pass whatever few scenes cannot exclude: on two scenes, losses of up
    /// to six standard errors.
    fn is_within_noise(&self) -> bool {
        self.mean <= self.standard_error
    }

    /// Returns true if a trial can replace the best: the scenes do not tell them apart, and its
    /// loss is at most [`LARGEST_LOSS`]. The second condition is for few or unlike scenes, whose
    /// standard error is large.
    pub fn is_acceptable(&self) -> bool {
        self.is_within_noise() && self.mean <= LARGEST_LOSS
    }
}

/// Chooses among the trials that keep the limits, by the scenes that `counts` selects. None if no
/// scene counts.
///
/// The start wins if the scenes do not tell it from the best. Otherwise, the trial nearest to the
/// start wins among those with an acceptable [`Loss`]. This is the one-standard-error rule
/// (Breiman, Friedman, Olshen and Stone, "Classification and Regression Trees", 1984, section
/// 3.4.3) with the standard error of the difference to the best (Yates, Aandahl, Richards and
/// Brook, "Cross validation for model selection", Ecological Monographs 93, 2023). The standard
/// error of the best trial's mean would be larger: on some scenes there is more to gain than on
/// others, for all candidates alike.
pub fn choose_trial(
    trials: &[Trial],
    space: &Space,
    limits: ChoiceLimits,
    counts: impl Fn(&str) -> bool,
) -> Option<Choice> {
    let start = trials.first()?;
    let error = |trial: &Trial| mean_log_ratio(&trial.scenes, &start.scenes, &counts);
    let allowed: Vec<(&Trial, f64)> = (trials.iter())
        .filter(|trial| limits.allow(trial))
        .map(|trial| Some((trial, error(trial)?)))
        .collect::<Option<_>>()?;
    let (best, _) = (allowed.iter().copied()).min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let loss = |trial: &Trial| Loss::new(trial, best, &counts);
    let distance = |trial: &Trial| space.distance(&trial_settings(space, trial), &space.start);
    let nearest = (allowed.iter())
        .filter(|(trial, _)| loss(trial).is_acceptable())
        .min_by(|(a, a_error), (b, b_error)| {
            let nearer = distance(a).total_cmp(&distance(b));
            nearer.then(a_error.total_cmp(b_error))
        });
    let chosen = match nearest {
        Some((nearest, _)) if !loss(start).is_within_noise() => nearest,
        _ => start,
    };
    Some(Choice {
        trial: chosen.trial,
        best: best.trial,
        loss: loss(chosen),
        reset: Vec::new(),
    })
}

/// Adds the values that all trials share to one trial's.
pub fn trial_settings(space: &Space, trial: &Trial) -> Settings {
    let mut settings = space.start.clone();
    settings.values.extend(trial.values.clone());
    settings
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

/// Leaves each family out of the choice in turn; returns nothing for a single family. The search
/// for trials used all scenes: folds show how much the choice among them overfits, and held-out
/// scenes show it for the search as well.
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
