//! The command `tune`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use suite::{
    Error, Evaluator, FilterChoice, Objective, RenderSettings, Sharing, Space, TuneOptions, Tuning,
    analyze_sensitivity, claim, compare_candidates, interleave_families, printable_path, tune,
    tuned_preset_toml,
};
use tracer::Progress;

use super::candidate::{
    candidate_render_settings, claim_and_render, open_candidate_gpu, select_candidate,
};
use super::plan::load_scenes;
use super::render_settings::make_render_settings;
use crate::arguments::TuneArgs;
use crate::output::print::{print, print_error};
use crate::output::progress::make_monitor;
use crate::tables::sensitivity::sensitivity_table;
use crate::tables::tuning::{paired_table, tuning_table};

/// Tunes, writes `journal.jsonl`, `tune.json` and the choice's values; or compares two presets.
pub fn execute(args: &TuneArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    match args.sobol {
        None => (),
        Some(rows @ (0 | 1)) => {
            return Err(Error::Usage(format!(
                "--sobol {rows}: allowed is 2 or more; a single row has no variance"
            )));
        }
        Some(rows) => return study_parameters(args, choice, rows),
    }
    match args.compare.as_slice() {
        [] => tune_filter(args, choice),
        [first, second] => compare_presets(args, choice, [first, second]),
        other => Err(Error::Usage(format!(
            "--compare {}: allowed are two presets, such as --compare paper,tuned",
            other.join(",")
        ))),
    }
}

fn tune_filter(args: &TuneArgs, choice: FilterChoice) -> Result<(), Error> {
    if args.budget == 0 {
        return Err(Error::Usage(
            "--budget 0: allowed is 1 or more; the first trial is the start itself".to_owned(),
        ));
    }
    let options = make_options(args, choice)?;
    options.check()?;
    let gpu = open_candidate_gpu(&options.choice, &args.candidate)?;
    let scenes = options.scenes.iter().chain(&options.held_out);
    let _claim = claim(&options.out, scenes.map(|(scene, _)| scene), Sharing::Alone)?;
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
    if !args.candidate.scenes.quiet {
        let seconds = began.elapsed().as_secs_f64();
        print_error(&format!("{} trials in {seconds:.1} s", tuning.trials));
    }
    print_result(args, &write_tuning(&tuning, &options)?)
}

fn make_options(args: &TuneArgs, choice: FilterChoice) -> Result<TuneOptions, Error> {
    let candidate = &args.candidate;
    let scene_args = &candidate.scenes;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let held_out = match args.sealed.as_slice() {
        [] => Vec::new(),
        words => load_scenes(&scene_args.scenes_dir, words)?,
    };
    let mut open = load_scenes(&scene_args.scenes_dir, &scene_args.scenes)?;
    if scene_args.scenes.is_empty() {
        // Every scene means every one that is not held out.
        open.retain(|(scene, _)| held_out.iter().all(|(other, _)| other.name != scene.name));
    }
    let mut held_out_args = scene_args.clone();
    held_out_args.samples_per_pixel = args.sealed_samples_per_pixel;
    Ok(TuneOptions {
        choice,
        space,
        scenes: interleave_families(open),
        held_out,
        render: candidate_render_settings(candidate)?,
        held_out_render: make_render_settings(
            &held_out_args,
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
        monitor: make_monitor(scene_args.quiet),
    })
}

/// A result, for people and for machines.
struct CommandResult {
    table: String,
    json: String,
    path: PathBuf,
}

fn print_result(args: &TuneArgs, found: &CommandResult) -> Result<(), Error> {
    let CommandResult { table, json, path } = found;
    match args.json {
        true => print(&format!("{json}\n")),
        false => print(&format!("{table}\nwritten: {}\n", printable_path(path))),
    }
}

/// Writes tune.json, params.json and preset.toml.
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
    write("preset.toml", &tuned_preset_toml(tuning, options))?;
    Ok(CommandResult {
        table: tuning_table(tuning) + "\nthe choice: params.json and preset.toml beside tune.json",
        json,
        path: options.out.join("tune.json"),
    })
}

fn compare_presets(
    tune: &TuneArgs,
    choice: FilterChoice,
    presets: [&String; 2],
) -> Result<(), Error> {
    let args = &tune.candidate;
    let [first, second] = presets.map(|preset| choice.preset_at(preset, args.size.0));
    let (first, second) = (first?, second?);
    let scenes = load_scenes(&args.scenes.scenes_dir, &args.scenes.scenes)?;
    let gpu = open_candidate_gpu(&choice, args)?;
    let (_claim, rendered) = claim_and_render(&scenes, &choice, args, Sharing::Alone)?;
    let bleed = args.objective.contains(&Objective::Bleed);
    let mut evaluator = Evaluator::new(
        gpu.as_ref(),
        &choice,
        &rendered,
        bleed,
        make_monitor(args.scenes.quiet),
    )?;
    let paired = compare_candidates(&mut evaluator, &first, &second)?;
    let names = presets.map(|preset| preset.as_str());
    let json = serde_json::to_string_pretty(&paired).expect("a comparison is plain data");
    let path = args.scenes.out.join("compare.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = paired_table(&paired, names);
    print_result(tune, &CommandResult { table, json, path })
}

fn study_parameters(args: &TuneArgs, choice: FilterChoice, rows: usize) -> Result<(), Error> {
    let candidate = &args.candidate;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let scenes = load_scenes(&candidate.scenes.scenes_dir, &candidate.scenes.scenes)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    let out = &candidate.scenes.out;
    let (_claim, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Alone)?;
    let mut evaluator = Evaluator::new(
        gpu.as_ref(),
        &choice,
        &rendered,
        false,
        make_monitor(candidate.scenes.quiet),
    )?;
    let label = format!("parameters of {}", choice.filter.name);
    let found = make_monitor(candidate.scenes.quiet).watch(&label, |watch| {
        analyze_sensitivity(&mut evaluator, &space, rows, args.search_seed, watch)
    })?;
    let json = serde_json::to_string_pretty(&found).expect("a study is plain data");
    let path = out.join("sensitivity.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = sensitivity_table(&found);
    print_result(args, &CommandResult { table, json, path })
}
