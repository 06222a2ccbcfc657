//! The main loop: ask, try, write down, tell.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::time::Instant;

use filters::{Gpu, Settings, Value};
use serde::{Deserialize, Serialize};
use tracer::{Scene, TraceError};

use super::compare::compare_paired;
use super::journal::{Header, JOURNAL_FORMAT, Journal};
use super::plan::{Objective, TunePlan};
use super::sealed::{Opening, record};
use super::selection::{Choice, Fold, choose, folds, settings};
use super::trying::{limits, next};
use super::{Evaluator, Search, Shot, Target, Trial, TrialOutcome, front};
use crate::judge::bounds::SceneBounds;
use crate::{Error, FilterChoice, Monitor, PROGRAM, RenderSettings};

/// Version of the layout of `tune.json`.
pub const TUNE_FORMAT: u32 = 1;

/// A finished tuning: `tune.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tuning {
    /// [`TUNE_FORMAT`].
    pub format: u32,
    /// What the trials depended on.
    pub journal: Header,
    /// How many there were.
    pub trials: usize,
    /// How many of them were dropped.
    pub dropped: usize,
    /// Those that did not run, with the reason.
    pub failed: BTreeMap<usize, String>,
    /// The start.
    pub start: Trial,
    /// What no other trial beats in everything, by their error.
    pub front: Vec<Trial>,
    /// What became of it.
    pub choice: Choice,
    /// The choice.
    pub chosen: Trial,
    /// The choice's value of every parameter: what `evaluate --params` reads.
    pub values: BTreeMap<String, Value>,
    /// How a choice without one family does on it.
    pub folds: Vec<Fold>,
    /// Looks at the sealed scenes, the last one at this choice; empty where there are none.
    pub openings: Vec<Opening>,
}

/// Tunes, and writes the journal; `told` hears every trial that is done.
pub fn tune(
    plan: &TunePlan,
    gpu: Option<&Gpu>,
    mut told: impl FnMut(&Trial),
) -> Result<Tuning, Error> {
    plan.check()?;
    let began = Instant::now();
    let shots = shots(
        &plan.scenes,
        &plan.choice,
        &plan.render,
        &plan.out,
        plan.monitor,
    )?;
    let bleed = plan.measures(Objective::Bleed);
    let mut evaluator = evaluator(&shots, &plan.choice, gpu, bleed, plan.monitor)?;
    let search = search(plan)?;
    let header = header(plan, &evaluator, &search);
    let mut journal = Journal::open(&plan.out.join("journal.jsonl"), &header)?;
    check_values(plan, &journal.trials)?;
    recall(&mut evaluator, plan, &journal.trials);
    while journal.trials.len() < plan.budget {
        if (plan.monitor.interrupted)() {
            return Err(TraceError::Cancelled.into());
        }
        let over = plan.time.is_some_and(|time| began.elapsed() >= time);
        if over && !journal.trials.is_empty() {
            break;
        }
        let trial = next(plan, &mut evaluator, &search, &journal.trials)?;
        told(&trial);
        journal.append(trial)?;
    }
    let mut tuning = conclude(plan, header, &journal.trials)?;
    if !plan.sealed.is_empty() {
        tuning.openings = open(plan, gpu, &tuning.values)?;
    }
    Ok(tuning)
}

/// Refuses trials of a journal with values that the filter does not take.
fn check_values(plan: &TunePlan, trials: &[Trial]) -> Result<(), Error> {
    for trial in trials {
        let mut settings = plan.choice.settings.clone();
        for (name, value) in &trial.values {
            (settings.set_value(&plan.choice.filter, name, value.clone())).map_err(|error| {
                // The header is the first line.
                Error::Usage(format!(
                    "{}:{}: {error}; choose another --out, or delete the file to begin anew",
                    plan.out.join("journal.jsonl").display(),
                    trial.trial + 2
                ))
            })?;
        }
    }
    Ok(())
}

/// Frames and truths of scenes, for the filter's alignment.
pub fn shots(
    scenes: &[(Scene, SceneBounds)],
    choice: &FilterChoice,
    render: &RenderSettings,
    out: &Path,
    monitor: Monitor,
) -> Result<Vec<Shot>, Error> {
    let alignment = choice.filter.alignment;
    (scenes.iter())
        .map(|(scene, bounds)| Shot::new((scene, bounds.clone()), alignment, render, out, monitor))
        .collect()
}

/// A filter on shots, nothing measured yet.
pub fn evaluator<'a>(
    shots: &'a [Shot],
    choice: &FilterChoice,
    gpu: Option<&'a Gpu>,
    bleed: bool,
    monitor: Monitor,
) -> Result<Evaluator<'a>, Error> {
    let targets = (shots.iter())
        .map(|shot| Target::new(shot, &choice.filter.name, &choice.preset))
        .collect::<Result<_, _>>()?;
    Evaluator::new(gpu, choice.clone(), targets, bleed, monitor)
}

/// The start, the other presets, and what follows. What tuning itself has found is left out: a search that is done again finds
/// it again, or not.
fn search(plan: &TunePlan) -> Result<Search, Error> {
    let mut points = vec![plan.space.point(&plan.space.start)];
    let published = plan.choice.filter.presets.iter();
    for preset in published.filter(|preset| preset.tuned.is_none()) {
        let point = plan
            .space
            .point(&plan.choice.preset_at(&preset.name, plan.render.width)?);
        if !points.contains(&point) {
            points.push(point);
        }
    }
    Ok(Search::new(points, plan.space.axes.len(), plan.seed))
}

fn header(plan: &TunePlan, evaluator: &Evaluator, search: &Search) -> Header {
    let scene = |target: &Target| {
        let hash = &target.shot.truth.provenance.content_hash;
        (target.shot.name.clone(), hash.clone())
    };
    let axis = |axis: &filters::Parameter| (axis.name.clone(), axis.kind.allowed());
    Header {
        format: JOURNAL_FORMAT,
        program: PROGRAM.to_owned(),
        filter: plan.choice.filter.name.clone(),
        start: plan.choice.preset.clone(),
        values: plan.space.start.values.clone(),
        vary: plan.space.axes.iter().map(axis).collect(),
        design: search.design.clone(),
        scenes: evaluator.targets.iter().map(scene).collect(),
        objectives: (plan.objectives.iter())
            .map(|objective| objective.name().to_owned())
            .collect(),
        cost_at_most: plan.cost_at_most,
        bleed_at_most: plan.bleed_at_most,
        race: plan.race,
        seed: plan.seed,
    }
}

/// What a journal knows need not be measured again.
fn recall(evaluator: &mut Evaluator, plan: &TunePlan, trials: &[Trial]) {
    for trial in trials {
        let settings = settings(&plan.space, trial);
        for (scene, score) in &trial.scenes {
            evaluator.remember(&settings, scene, *score);
        }
    }
}

/// What the trials come to.
fn conclude(plan: &TunePlan, header: Header, trials: &[Trial]) -> Result<Tuning, Error> {
    let limits = limits(plan, trials);
    let choice = choose(trials, &plan.space, limits, |_| true)
        .expect("the start is always allowed, and has scenes");
    let done: Vec<&Trial> = trials.iter().filter(|trial| trial.is_done()).collect();
    let rows: Vec<Vec<f64>> = done.iter().map(|trial| objectives(trial)).collect();
    let mut front: Vec<Trial> = (front(&rows).into_iter())
        .map(|index| done[index].clone())
        .collect();
    let error = |trial: &Trial| trial.error.expect("it is done");
    front.sort_by(|a, b| error(a).total_cmp(&error(b)));
    let failed = trials.iter().filter_map(|trial| match &trial.outcome {
        TrialOutcome::Failed { reason } => Some((trial.trial, reason.clone())),
        _ => None,
    });
    let chosen = trials[choice.trial].clone();
    Ok(Tuning {
        format: TUNE_FORMAT,
        journal: header,
        trials: trials.len(),
        dropped: (trials.iter())
            .filter(|trial| trial.outcome == TrialOutcome::Dropped)
            .count(),
        failed: failed.collect(),
        start: trials[0].clone(),
        front,
        choice,
        values: settings(&plan.space, &chosen).values,
        chosen,
        folds: folds(trials, &plan.space, limits, &plan.families()),
        openings: Vec::new(),
    })
}

/// What is measured of a trial that is done, in the same order for all.
fn objectives(trial: &Trial) -> Vec<f64> {
    let measured = [trial.error, trial.bleed, trial.cost];
    measured.into_iter().flatten().collect()
}

/// Compares start and choice on the sealed scenes, and counts the look.
fn open(
    plan: &TunePlan,
    gpu: Option<&Gpu>,
    values: &BTreeMap<String, Value>,
) -> Result<Vec<Opening>, Error> {
    let render = &plan.sealed_render;
    let out = plan.out.join("sealed");
    let shots = shots(&plan.sealed, &plan.choice, render, &out, plan.monitor)?;
    let mut evaluator = evaluator(&shots, &plan.choice, gpu, true, plan.monitor)?;
    let start = plan.choice.preset_at(&plan.choice.preset, render.width)?;
    // What was found on pictures of one width is scaled to those of another as the start is.
    let start_width = plan.space.start.reference_width;
    let chosen = Settings {
        values: values.clone(),
        reference_width: start_width.map(|_| plan.render.width),
        fixed: BTreeSet::new(),
        ..start.clone()
    };
    let chosen = chosen.scaled_to(&plan.choice.filter, render.width);
    let paired = compare_paired(&mut evaluator, &start, &chosen)?;
    let size = [render.width, render.height, render.samples_per_pixel];
    record(&plan.out.join("openings.jsonl"), values, size, paired)
}
