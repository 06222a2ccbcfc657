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
    /// GPU time relative to that of the start.
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
        // The limits are relative to the start; noise of the clock must not exclude it.
        let is_start = trial.trial == 0;
        trial.is_done()
            && (is_start || holds(trial.cost, self.cost) && holds(trial.bleed, self.bleed))
    }
}

/// Trial that the one-standard-error rule takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Number of the chosen trial.
    pub trial: usize,
    /// Number of the trial with the least error.
    pub best: usize,
    /// Standard error of the best one's mean over scenes of log(error / error of the start).
    pub standard_error: f64,
}

/// Chooses among the trials that keep the limits, by their means over the scenes that `counts` takes: the trial nearest to the
/// start of all within one standard error of the best. So the start wins where the scenes cannot tell (Breiman, Friedman, Olshen
/// and Stone, "Classification and Regression Trees", 1984, section 3.4.3). None if no scene counts.
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

/// Adds the values that all trials share to those of one trial.
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

/// Result on one family of scenes of a choice that was made without it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Family that was left out.
    pub family: String,
    /// Number of its scenes.
    pub scenes: usize,
    /// Trial that the other families choose.
    pub trial: usize,
    /// The trial's mean log(error / error of the start) on the others.
    pub others: f64,
    /// The trial's mean on the family that was left out.
    pub held_out: f64,
    /// `held_out - others`: above 0, the choice is worse on the family that it was not chosen for.
    pub gap: f64,
}

/// Leaves each family out of the choice in turn; returns nothing for a single family. The trials themselves were searched for on
/// all scenes: folds show how much the choice among them overfits, and held-out scenes show that of the search as well.
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

#[cfg(test)]
mod tests {
    use filters::{Filter, Value};

    use super::*;
    use crate::{SceneScore, TrialOutcome};

    /// Makes a start with samples = 8, and trials with other numbers of samples and the given FLIP on scenes a, b, c, d.
    fn make_trials(rows: &[(i32, [f64; 4])]) -> Vec<Trial> {
        let score = |flip: &f64| SceneScore {
            flip: *flip,
            bleed: None,
        };
        let make = |(trial, (samples, flips)): (usize, &(i32, [f64; 4]))| Trial {
            trial,
            values: BTreeMap::from([("samples".to_owned(), Value::Integer(*samples))]),
            outcome: TrialOutcome::Done,
            loss: 0.0,
            error: None,
            bleed: Some(f64::from(*samples) / 8.0),
            cost: Some(f64::from(*samples) / 8.0),
            scenes: ["a", "b", "c", "d"]
                .map(str::to_owned)
                .into_iter()
                .zip(flips.iter().map(score))
                .collect(),
        };
        rows.iter().enumerate().map(make).collect()
    }

    fn space() -> Space {
        let filter = Filter::builtin("jump_flood").unwrap();
        let start = filter.settings(Some("paper")).unwrap();
        Space::new(&filter, start, &["samples".to_owned()]).unwrap()
    }

    fn choose(trials: &[Trial], limits: ChoiceLimits) -> Choice {
        choose_trial(trials, &space(), limits, |_| true).unwrap()
    }

    #[test]
    fn the_choice_among_equal_candidates_is_the_nearest_to_the_start() {
        let trials = make_trials(&[
            (8, [0.1, 0.1, 0.1, 0.1]),
            // About half the error everywhere: the best.
            (60, [0.05, 0.04, 0.06, 0.05]),
            // Hardly worse, and much nearer to the start.
            (12, [0.05, 0.042, 0.06, 0.05]),
            // Nearer still, and clearly worse.
            (10, [0.08, 0.08, 0.08, 0.08]),
        ]);
        let choice = choose(&trials, ChoiceLimits::default());
        assert_eq!((choice.best, choice.trial), (1, 2));
        // Logs of 0.5, 0.4, 0.6 and 0.5: the standard deviation is 0.1659, and that of the mean 0.0830.
        let error = choice.standard_error;
        assert!((error - 0.0830).abs() < 1e-4, "{error}");
        // A start that is not beaten everywhere stays.
        let trials = make_trials(&[(8, [0.1; 4]), (9, [0.05, 0.16, 0.09, 0.11])]);
        let choice = choose(&trials, ChoiceLimits::default());
        assert_eq!((choice.best, choice.trial), (1, 0));
    }

    #[test]
    fn limits_and_failures_keep_trials_out_of_the_choice() {
        let rows = [
            (8, [0.1; 4]),
            (16, [0.02; 4]),
            (12, [0.05; 4]),
            (4, [0.06; 4]),
        ];
        let mut trials = make_trials(&rows);
        let chosen =
            |trials: &[Trial], cost, bleed| choose(trials, ChoiceLimits { cost, bleed }).trial;
        assert_eq!(chosen(&trials, None, None), 1);
        assert_eq!(chosen(&trials, Some(1.5), None), 2);
        assert_eq!(chosen(&trials, None, Some(1.0)), 3);
        trials[1].outcome = TrialOutcome::Dropped;
        assert_eq!(chosen(&trials, None, None), 2);
        let reason = "it serves a test".to_owned();
        trials[2].outcome = TrialOutcome::Failed { reason };
        assert_eq!(chosen(&trials, None, None), 3);
    }

    #[test]
    fn a_choice_that_suits_only_one_family_shows_its_gap() {
        // One trial suits the camera, the other suits thin things; each doubles the other's error.
        let trials = make_trials(&[
            (8, [0.1; 4]),
            (9, [0.05, 0.05, 0.2, 0.2]),
            (10, [0.2, 0.2, 0.05, 0.05]),
        ]);
        let validate = |families: &[(&'static str, &str)]| {
            let names = |scenes: &str| scenes.split(' ').map(str::to_owned).collect();
            let families = families.iter().map(|(name, scenes)| (*name, names(scenes)));
            cross_validate(
                &trials,
                &space(),
                ChoiceLimits::default(),
                &families.collect(),
            )
        };
        let folds = validate(&[("camera", "a b"), ("thin", "c d")]);
        let two = 2f64.ln();
        assert_eq!(folds.len(), 2);
        for (fold, (family, trial)) in folds.iter().zip([("camera", 2), ("thin", 1)]) {
            assert_eq!(
                (fold.family.as_str(), fold.trial, fold.scenes),
                (family, trial, 2)
            );
            // Exact except for the logarithm's rounding.
            assert!((fold.others + two).abs() < 1e-12 && (fold.held_out - two).abs() < 1e-12);
            assert!((fold.gap - 2.0 * two).abs() < 1e-12, "{}", fold.gap);
        }
        assert!(validate(&[("camera", "a b c d")]).is_empty());
    }
}
