//! The command `tune`.

use std::io::ErrorKind;
use std::path::Path;
use std::time::{Duration, Instant};

use frame::FileError;
use suite::{
    Advice, Error, FilterChoice, Sharing, Space, TuneOptions, Tuning, claim, interleave_families,
    tune, tuned_preset_toml,
};
use tracer::{Progress, RenderSettings};

use super::candidate::{
    candidate_render_settings, load_candidate_scenes, open_candidate_gpu, print_expected_scoring,
    select_candidate,
};
use super::render_settings::make_render_settings;
use super::result::CommandResult;
use super::run_plan::load_scenes;
use crate::arguments::TuneArgs;
use crate::output::print::print_error;
use crate::output::progress::make_monitor;
use crate::output::verbosity::is_quiet;
use crate::tables::tuning::{advice_text, tuning_table};

/// Tunes, writes `journal.jsonl`, `tune.json` and the choice's values, prints the table.
pub fn execute(args: &TuneArgs) -> Result<(), Error> {
    let choice = select_candidate(&args.candidate)?;
    if args.budget == 0 {
        return Err(Error::Usage(
            "--budget 0; allowed: 1 or more; the first trial is the start itself".to_owned(),
        ));
    }
    let options = make_options(args, choice)?;
    options.check()?;
    let gpu = open_candidate_gpu(&options.choice, &args.candidate)?;
    let scenes = options.scenes.iter().chain(&options.held_out);
    let _claim = claim(&options.out, scenes.map(|(scene, _)| scene), Sharing::Alone)?;
    // A race drops many candidates early.
    let limit = (options.time).map_or(f64::INFINITY, |time| time.as_secs_f64());
    print_expected_scoring(&options.scenes, &options.render, options.budget, limit);
    let began = Instant::now();
    let label = format!("tuning {}", options.choice.filter.name);
    let tuning = options.monitor.watch(&label, |watch| {
        tune(&options, gpu.as_ref(), |trial| {
            // The loop itself ends where it is interrupted.
            let _ = watch(Progress {
                done: trial.trial as u64 + 1,
                total: options.budget as u64,
            });
        })
    })?;
    if !is_quiet() {
        let seconds = began.elapsed().as_secs_f64();
        print_error(&format!("{} trials in {seconds:.1} s", tuning.trials));
    }
    write_tuning(&tuning, &options)?.print(args.json)
}

fn make_options(args: &TuneArgs, choice: FilterChoice) -> Result<TuneOptions, Error> {
    let candidate = &args.candidate;
    let scene_args = &candidate.scenes;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let held_out = match args.held_out.as_slice() {
        [] => Vec::new(),
        words => load_scenes(&scene_args.scenes_dir, words, Some(args.held_out_size))?,
    };
    let mut open = load_candidate_scenes(candidate)?;
    if scene_args.scenes.is_empty() {
        // Every scene means every one that is not held out.
        open.retain(|(scene, _)| held_out.iter().all(|(other, _)| other.id != scene.id));
    }
    let mut held_out_args = scene_args.clone();
    held_out_args.samples_per_pixel = args.held_out_samples_per_pixel;
    Ok(TuneOptions {
        choice,
        space,
        scenes: interleave_families(open),
        held_out,
        render: candidate_render_settings(candidate)?,
        held_out_render: make_render_settings(
            &held_out_args,
            args.held_out_size,
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

/// Writes tune.json, params.json and, where the choice is worth taking, preset.toml; else removes that of an earlier tuning.
fn write_tuning(tuning: &Tuning, options: &TuneOptions) -> Result<CommandResult, Error> {
    let pretty = |json: Result<String, serde_json::Error>| json.expect("a tuning is plain data");
    let write = |name: &str, text: &str| {
        frame::write_atomically(&options.out.join(name), text.as_bytes()).map_err(Error::from)
    };
    let json = pretty(serde_json::to_string_pretty(tuning));
    write("tune.json", &json)?;
    write(
        "params.json",
        &pretty(serde_json::to_string_pretty(&tuning.values)),
    )?;
    match tuning.advice() {
        Advice::Take => write("preset.toml", &tuned_preset_toml(tuning, options))?,
        _ => remove_file(&options.out.join("preset.toml"))?,
    }
    Ok(CommandResult {
        table: tuning_table(tuning) + "\n" + advice_text(tuning).trim_end(),
        json,
        path: options.out.join("tune.json"),
    })
}

/// Removes a file, if there is one.
fn remove_file(path: &Path) -> Result<(), Error> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(FileError::io(path, "remove", error).into())
        }
        _ => Ok(()),
    }
}
