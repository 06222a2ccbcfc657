//! Tuning of a filter's parameters, from the first trial to the result.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use filters::{Gpu, Parameter, Settings, Value};
use measure::{Error, PROGRAM};
use serde::{Deserialize, Serialize};
use tracer::TraceError;

use crate::ablation::ablate_choice;
use crate::comparison::compare_candidates;
use crate::evaluator::Evaluator;
use crate::held_out::{HeldOutResult, record_held_out_result};
use crate::journal::{Journal, journal_error};
use crate::next_trial::run_next_trial;
use crate::options::TuneOptions;
use crate::pareto::{pareto_front, round_bleed};
use crate::search::Search;
use crate::selection::{Choice, Fold, choose_trial, cross_validate, trial_settings};
use crate::target::{Target, render_scenes};
use crate::trial::{JOURNAL_FORMAT, JournalHeader, Objective, Trial, TrialOutcome};

/// Version of the layout of `tune.json`.
pub const TUNE_FORMAT: u32 = 2;

/// A finished tuning: `tune.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tuning {
    /// [`TUNE_FORMAT`].
    pub format: u32,
    /// First line of the journal: everything that the trials depend on.
    pub journal: JournalHeader,
    /// Number of trials.
    pub trials: usize,
    /// Number of trials that were dropped early.
    pub dropped: usize,
    /// Trials that did not run, with the reason.
    pub failed: BTreeMap<usize, String>,
    /// The first trial: the values to start from.
    pub start: Trial,
    /// Pareto front of the trials, by their error.
    pub front: Vec<Trial>,
    /// Choice among the trials.
    pub choice: Choice,
    /// The chosen trial, with the parameters of [`Choice::reset`] at the start.
    pub chosen: Trial,
    /// The choice's value of every parameter, as the command `evaluate` reads them.
    pub values: BTreeMap<String, Value>,
    /// Cross-validation over the families of scenes.
    pub folds: Vec<Fold>,
    /// Results on the held-out scenes, with this choice's last; empty without such scenes.
    #[serde(rename = "openings")]
    pub held_out: Vec<HeldOutResult>,
}

/// Tunes, and writes the journal; calls `on_trial` with every finished trial.
pub fn tune(
    options: &TuneOptions,
    gpu: Option<&Gpu>,
    mut on_trial: impl FnMut(&Trial),
) -> Result<Tuning, Error> {
    options.check()?;
    let began = Instant::now();
    let TuneOptions {
        choice,
        render,
        out,
        monitor,
        ..
    } = options;
    let filter = &choice.filter;
    let scenes = render_scenes(&options.scenes, filter, render, out, *monitor)?;
    let bleed = options.measures(Objective::Bleed);
    let mut evaluator = Evaluator::new(gpu, choice, &scenes, bleed, *monitor)?;
    let search = make_search(options)?;
    let header = make_header(options, &evaluator, &search);
    let mut journal = Journal::open(&out.join("journal.jsonl"), &header)?;
    remember_trials(&mut evaluator, options, &journal.trials)?;
    while journal.trials.len() < options.budget {
        if (monitor.interrupted)() {
            return Err(TraceError::Cancelled.into());
        }
        let over = options.time.is_some_and(|time| began.elapsed() >= time);
        if over && !journal.trials.is_empty() {
            break;
        }
        let trial = run_next_trial(options, &mut evaluator, &search, &journal.trials)?;
        on_trial(&trial);
        journal.append(trial)?;
    }
    let mut tuning = conclude(options, &mut evaluator, header, &journal.trials)?;
    if !options.held_out.is_empty() {
        tuning.held_out = evaluate_held_out(options, gpu, &tuning.values)?;
    }
    Ok(tuning)
}

/// Hands the scores of a journal to the evaluator, which then need not measure them again. Refuses
/// trials with values that the filter does not accept.
fn remember_trials(
    evaluator: &mut Evaluator,
    options: &TuneOptions,
    trials: &[Trial],
) -> Result<(), Error> {
    for trial in trials {
        let mut settings = options.space.start.clone();
        for (name, value) in &trial.values {
            (settings.set_value(&options.choice.filter, name, value.clone())).map_err(|error| {
                // The header is the first line.
                let line = trial.trial + 1;
                journal_error(&options.out.join("journal.jsonl"), line, &error.to_string())
            })?;
        }
        evaluator.remember(&settings, &trial.scenes);
    }
    Ok(())
}

/// Makes a search that begins with the start and the other presets, except presets that tuning
/// itself found: another search has to find them again.
fn make_search(options: &TuneOptions) -> Result<Search, Error> {
    let space = &options.space;
    let mut points = vec![space.point(&space.start)];
    let published = options.choice.filter.presets.iter();
    for preset in published.filter(|preset| preset.tuned.is_none()) {
        let settings = options
            .choice
            .preset_at(&preset.name, options.render.width)?;
        let point = space.point(&settings);
        if !points.contains(&point) {
            points.push(point);
        }
    }
    Ok(Search::new(points, space.axes.len(), options.seed))
}

fn make_header(options: &TuneOptions, evaluator: &Evaluator, search: &Search) -> JournalHeader {
    let scene = |target: &Target| {
        let hash = &target.scene.truth.provenance.content_hash;
        (target.scene.name.clone(), hash.clone())
    };
    let axis = |axis: &Parameter| (axis.name.clone(), axis.kind.allowed());
    JournalHeader {
        format: JOURNAL_FORMAT,
        program: PROGRAM.to_owned(),
        filter: options.choice.filter.name.clone(),
        start: options.choice.preset.clone(),
        values: options.space.start.values.clone(),
        vary: options.space.axes.iter().map(axis).collect(),
        design: search.design.clone(),
        scenes: evaluator.targets.iter().map(scene).collect(),
        objectives: options.objectives.clone(),
        cost_at_most: options.cost_at_most,
        bleed_at_most: options.bleed_at_most,
        race: options.race,
        seed: options.seed,
    }
}

/// Chooses among the trials and summarises them.
fn conclude(
    options: &TuneOptions,
    evaluator: &mut Evaluator,
    header: JournalHeader,
    trials: &[Trial],
) -> Result<Tuning, Error> {
    let space = &options.space;
    let limits = options.choice_limits(&trials[0]);
    let mut choice = choose_trial(trials, space, limits, |_| true)
        .expect("the start is always allowed, and has scenes");
    let chosen = ablate_choice(options, evaluator, trials, &mut choice)?;
    // The choice replaces the trial that it was made from.
    let done: Vec<&Trial> = (trials.iter().filter(|trial| trial.is_done()))
        .map(|trial| {
            if trial.trial == chosen.trial {
                &chosen
            } else {
                trial
            }
        })
        .collect();
    let measured =
        |trial: &&Trial| [trial.error, trial.bleed.map(round_bleed), trial.cost].into_iter();
    let rows: Vec<Vec<f64>> = done
        .iter()
        .map(|trial| measured(trial).flatten().collect())
        .collect();
    let mut front: Vec<Trial> = (pareto_front(&rows).into_iter())
        .map(|index| done[index].clone())
        .collect();
    let error = |trial: &Trial| trial.error.expect("it is done");
    front.sort_by(|a, b| error(a).total_cmp(&error(b)));
    let failed = trials.iter().filter_map(|trial| match &trial.outcome {
        TrialOutcome::Failed { reason } => Some((trial.trial, reason.clone())),
        _ => None,
    });
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
        values: trial_settings(space, &chosen).values,
        chosen,
        folds: cross_validate(trials, space, limits, &options.families()),
        held_out: Vec::new(),
    })
}

/// Compares start and choice on the held-out scenes, and records the result.
fn evaluate_held_out(
    options: &TuneOptions,
    gpu: Option<&Gpu>,
    values: &BTreeMap<String, Value>,
) -> Result<Vec<HeldOutResult>, Error> {
    let TuneOptions {
        choice,
        held_out_render: render,
        out,
        monitor,
        ..
    } = options;
    let filter = &choice.filter;
    let folder = out.join("held_out");
    let scenes = render_scenes(&options.held_out, filter, render, &folder, *monitor)?;
    let mut evaluator = Evaluator::new(gpu, choice, &scenes, true, *monitor)?;
    let start = choice.preset_at(&choice.preset, render.width)?;
    // Values from pictures of one width are scaled to another like the start's.
    let start_width = options.space.start.reference_width;
    let chosen = Settings {
        values: values.clone(),
        reference_width: start_width.map(|_| options.render.width),
        fixed: BTreeSet::new(),
        ..start.clone()
    };
    let chosen = chosen.scaled_to(&choice.filter, render.width);
    let paired = compare_candidates(&mut evaluator, &start, &chosen)?;
    let size = [render.width, render.height, render.samples_per_pixel];
    record_held_out_result(&out.join("openings.jsonl"), values, size, paired)
}
