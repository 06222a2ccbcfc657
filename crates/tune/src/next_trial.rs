//! Next trial of a tuning: asks the search for a candidate, scores it and rates it.

use std::collections::BTreeMap;

use filters::{FilterError, Settings};
use measure::Error;

use crate::evaluator::Evaluator;
use crate::loss::{FAILED, bounds_penalty, log_ratios, mean_log_ratio, penalty, worst_bleed};
use crate::options::TuneOptions;
use crate::search::Search;
use crate::selection::ChoiceLimits;
use crate::target::SceneScore;
use crate::trial::{Objective, Trial, TrialOutcome};
use crate::wilcoxon::signed_rank_p_value;

/// Scenes that a candidate runs on before it can be dropped.
const RACE_FROM: usize = 6;
/// Scenes between later checks, the number processed at once.
const RACE_STEP: usize = 2;
/// Probability that chance alone makes a candidate look so bad; below it, the candidate is dropped.
const RACE_LEVEL: f64 = 0.1;

/// Asks the search for the next candidate and runs it.
pub fn run_next_trial(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    search: &Search,
    trials: &[Trial],
) -> Result<Trial, Error> {
    let losses: Vec<f64> = trials.iter().map(|trial| trial.loss).collect();
    let settings = match trials.len() {
        0 => options.space.start.clone(),
        _ => options.space.settings(&search.ask(&losses)),
    };
    run_trial(options, evaluator, trials, &settings)
}

/// Runs a candidate after other trials. A candidate that the filter fails on is a failed trial,
/// unless it is the start.
pub fn run_trial(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    trials: &[Trial],
    settings: &Settings,
) -> Result<Trial, Error> {
    let values = (options.space.axes.iter())
        .map(|axis| (axis.name.clone(), settings.values[&axis.name].clone()))
        .collect();
    let mut trial = Trial {
        trial: trials.len(),
        values,
        outcome: TrialOutcome::Done,
        loss: FAILED,
        error: None,
        bleed: None,
        cost: None,
        scenes: BTreeMap::new(),
    };
    match measure_trial(options, evaluator, trials, settings, &mut trial) {
        Ok(()) => Ok(trial),
        Err(error @ (Error::Trace(_) | Error::Filter(FilterError::Interrupted))) => Err(error),
        Err(error) if trials.is_empty() => Err(error),
        Err(error) => {
            trial.outcome = TrialOutcome::Failed {
                reason: error.to_string(),
            };
            trial.loss = FAILED;
            trial.error = None;
            Ok(trial)
        }
    }
}

/// Scores a candidate on each scene, and fills in the trial.
fn measure_trial(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    trials: &[Trial],
    settings: &Settings,
    trial: &mut Trial,
) -> Result<(), Error> {
    race(options, evaluator, trials, settings, trial)?;
    let start = trials.first().map_or(&trial.scenes, |trial| &trial.scenes);
    let error = mean_log_ratio(&trial.scenes, start, |_| true).expect("there are scenes");
    let excess: f64 = (evaluator.targets.iter())
        .filter_map(|target| {
            let name = &target.scene.name;
            Some(target.excess(trial.scenes.get(name)?, &start[name]))
        })
        .sum::<f64>()
        / trial.scenes.len() as f64;
    trial.error = Some(error);
    trial.bleed = worst_bleed(&trial.scenes);
    if options.measures(Objective::Cost) && trial.is_done() {
        let same = trials.iter().find(|other| other.values == trial.values);
        trial.cost = match same.and_then(|same| same.cost) {
            _ if trials.is_empty() => Some(1.0),
            Some(cost) => Some(cost),
            None => evaluator.measure_cost(settings, 0)?,
        };
    }
    let limits = if trials.is_empty() {
        ChoiceLimits::default()
    } else {
        options.choice_limits(&trials[0])
    };
    trial.loss = error
        + bounds_penalty(excess)
        + penalty(trial.bleed, limits.bleed)
        + penalty(trial.cost, limits.cost);
    Ok(())
}

/// Scores a candidate scene by scene, until it is clearly worse than the best trial so far.
fn race(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    trials: &[Trial],
    settings: &Settings,
    trial: &mut Trial,
) -> Result<(), Error> {
    let best = (trials.iter().filter(|trial| trial.is_done()))
        .min_by(|a, b| a.loss.total_cmp(&b.loss))
        .filter(|_| options.race);
    let mut left = evaluator.all_scenes();
    while !left.is_empty() {
        let step = match best {
            None => left.len(),
            Some(_) if trial.scenes.is_empty() => RACE_FROM,
            Some(_) => RACE_STEP,
        };
        let next: Vec<usize> = left.drain(..step.min(left.len())).collect();
        let is_wanted = |_: usize, _: &SceneScore| !(options.monitor.interrupted)();
        trial
            .scenes
            .extend(evaluator.score(settings, &next, is_wanted)?);
        if !left.is_empty() && best.is_some_and(|best| is_clearly_worse(trial, best)) {
            trial.outcome = TrialOutcome::Dropped;
            break;
        }
    }
    Ok(())
}

fn is_clearly_worse(trial: &Trial, best: &Trial) -> bool {
    signed_rank_p_value(&log_ratios(&trial.scenes, &best.scenes, |_| true)) < RACE_LEVEL
}
