//! The command `tune`.

use std::time::{Duration, Instant};

use suite::{
    Error, FilterChoice, RenderSettings, Sharing, Space, TunePlan, Tuning, claim,
    estimate_case_seconds, estimate_render_seconds, interleaved, preset_text, tune,
};
use tracer::Progress;

use super::candidate::{candidate_render_settings, open_candidate_gpu, select_candidate};
use super::expected::print_expected_time;
use super::plan::load_scenes;
use super::render_settings::make_render_settings;
use super::result::CommandResult;
use crate::arguments::TuneArgs;
use crate::output::print::print_error;
use crate::output::progress::make_monitor;
use crate::output::verbosity::is_quiet;
use crate::tables::tuning::tuning_table;

/// Tunes, writes `journal.jsonl`, `tune.json` and the choice's values, prints the table.
pub fn execute(args: &TuneArgs) -> Result<(), Error> {
    let choice = select_candidate(&args.candidate)?;
    let plan = make_plan(args, choice)?;
    plan.check()?;
    let gpu = open_candidate_gpu(&plan.choice, &args.candidate)?;
    let scenes = plan.scenes.iter().chain(&plan.sealed);
    let _claim = claim(&plan.out, scenes.map(|(scene, _)| scene), Sharing::Alone)?;
    print_expected_tuning(&plan);
    let began = Instant::now();
    let label = format!("tuning {}", plan.choice.filter.name);
    let tuning = plan.monitor.watch(&label, |watch| {
        tune(&plan, gpu.as_ref(), |trial| {
            // The loop itself ends where it is interrupted.
            let _ = watch(Progress {
                done: trial.trial as u64 + 1,
                total: plan.budget as u64,
            });
        })
    })?;
    if !is_quiet() {
        let seconds = began.elapsed().as_secs_f64();
        print_error(&format!("{} trials in {seconds:.1} s", tuning.trials));
    }
    write_tuning(&tuning, &plan)?.print(args.json)
}

/// Prints the expected time of a tuning whose scenes are not rendered yet. A race drops many candidates early.
fn print_expected_tuning(plan: &TunePlan) {
    let scenes = plan.scenes.len() as f64;
    let rendering = scenes * estimate_render_seconds(&plan.render, 1);
    let trials = plan.budget as f64 * scenes * estimate_case_seconds(&plan.render);
    let limit = plan.time.map_or(f64::INFINITY, |time| time.as_secs_f64());
    let more = format!("{} candidates on {} scenes", plan.budget, plan.scenes.len());
    print_expected_time(rendering + trials.min(limit), &more);
}

fn make_plan(args: &TuneArgs, choice: FilterChoice) -> Result<TunePlan, Error> {
    let candidate = &args.candidate;
    let scene_args = &candidate.scenes;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let sealed = match args.sealed.as_slice() {
        [] => Vec::new(),
        words => load_scenes(&scene_args.scenes_dir, words)?,
    };
    let mut open = load_scenes(&scene_args.scenes_dir, &scene_args.scenes)?;
    if scene_args.scenes.is_empty() {
        // Every scene means every one that is not sealed.
        open.retain(|(scene, _)| sealed.iter().all(|(other, _)| other.name != scene.name));
    }
    let mut sealed_args = scene_args.clone();
    sealed_args.samples_per_pixel = args.sealed_samples_per_pixel;
    Ok(TunePlan {
        choice,
        space,
        scenes: interleaved(open),
        sealed,
        render: candidate_render_settings(candidate)?,
        sealed_render: make_render_settings(
            &sealed_args,
            args.sealed_size,
            RenderSettings::default().replicates,
        )?,
        objectives: candidate.objective.clone(),
        cost_at_most: args.cost_at_most,
        bleed_at_most: args.bleed_at_most,
        budget: args.budget,
        time: args.minutes.map(|it| Duration::from_secs_f64(60.0 * it)),
        race: !args.no_race,
        seed: args.search_seed,
        out: scene_args.out.clone(),
        monitor: make_monitor(),
    })
}

/// Writes tune.json, params.json and preset.toml.
fn write_tuning(tuning: &Tuning, plan: &TunePlan) -> Result<CommandResult, Error> {
    let pretty = |json: Result<String, serde_json::Error>| json.expect("a tuning is plain data");
    let write = |name: &str, text: &str| {
        frame::write_atomically(&plan.out.join(name), text.as_bytes()).map_err(Error::from)
    };
    let json = pretty(serde_json::to_string_pretty(tuning));
    write("tune.json", &json)?;
    write(
        "params.json",
        &pretty(serde_json::to_string_pretty(&tuning.values)),
    )?;
    write("preset.toml", &preset_text(tuning, plan))?;
    Ok(CommandResult {
        table: tuning_table(tuning) + "\nthe choice: params.json and preset.toml beside tune.json",
        json,
        path: plan.out.join("tune.json"),
    })
}
