//! `shuttertruth tune`

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::output::progress::{monitor, tell};
use crate::selection::select_filters;
use crate::tables::sensitivity::sensitivity_table;
use crate::tables::tuning::{paired_table, tuning_table};
use filters::Gpu;
use suite::{
    Claim, Error, Evaluator, FilterChoice, Objective, RenderSettings, RenderedScene, SceneBounds,
    Sharing, Space, TuneOptions, Tuning, analyze_sensitivity, claim, compare_candidates,
    interleave_families, open_gpu, printable_path, render_scenes, tune, tuned_preset_toml,
};
use tracer::{Progress, Scene};

use super::measure::scenes;
use super::{render_settings, say};
use crate::arguments::{CandidateArgs, SceneArgs, TuneArgs};

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
        Some(rows) => return study(args, choice, rows),
    }
    match args.compare.as_slice() {
        [] => run(args, choice),
        [first, second] => compare(args, choice, [first, second]),
        other => Err(Error::Usage(format!(
            "--compare {}: allowed are two presets, such as --compare paper,tuned",
            other.join(",")
        ))),
    }
}

fn run(args: &TuneArgs, choice: FilterChoice) -> Result<(), Error> {
    if args.budget == 0 {
        return Err(Error::Usage(
            "--budget 0: allowed is 1 or more; the first trial is the start itself".to_owned(),
        ));
    }
    let options = tune_options(args, choice)?;
    options.check()?;
    let gpu = open(&options.choice, &args.candidate)?;
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
        tell(&format!("{} trials in {seconds:.1} s", tuning.trials));
    }
    print(args, &write(&tuning, &options)?)
}

fn tune_options(args: &TuneArgs, choice: FilterChoice) -> Result<TuneOptions, Error> {
    let candidate = &args.candidate;
    let scene_args = &candidate.scenes;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let held_out = match args.sealed.as_slice() {
        [] => Vec::new(),
        words => scenes(&scene_args.scenes_dir, words)?,
    };
    let mut open = scenes(&scene_args.scenes_dir, &scene_args.scenes)?;
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
        render: render(candidate)?,
        held_out_render: render_settings(
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
        monitor: monitor(scene_args.quiet),
    })
}

/// What a command found, for people and for machines.
struct Found {
    table: String,
    json: String,
    path: PathBuf,
}

fn print(args: &TuneArgs, found: &Found) -> Result<(), Error> {
    let Found { table, json, path } = found;
    match args.json {
        true => say(&format!("{json}\n")),
        false => say(&format!("{table}\nwritten: {}\n", printable_path(path))),
    }
}

/// Writes what was found.
fn write(tuning: &Tuning, options: &TuneOptions) -> Result<Found, Error> {
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
    Ok(Found {
        table: tuning_table(tuning) + "\nthe choice: params.json and preset.toml beside tune.json",
        json,
        path: options.out.join("tune.json"),
    })
}

fn compare(tune: &TuneArgs, choice: FilterChoice, presets: [&String; 2]) -> Result<(), Error> {
    let args = &tune.candidate;
    let [first, second] = presets.map(|preset| choice.preset_at(preset, args.size.0));
    let (first, second) = (first?, second?);
    let scenes = scenes(&args.scenes.scenes_dir, &args.scenes.scenes)?;
    let gpu = open(&choice, args)?;
    let (_claim, rendered) = claim_and_render(&scenes, &choice, args, Sharing::Alone)?;
    let bleed = args.objective.contains(&Objective::Bleed);
    let mut evaluator = Evaluator::new(
        gpu.as_ref(),
        &choice,
        &rendered,
        bleed,
        monitor(args.scenes.quiet),
    )?;
    let paired = compare_candidates(&mut evaluator, &first, &second)?;
    let names = presets.map(|preset| preset.as_str());
    let json = serde_json::to_string_pretty(&paired).expect("a comparison is plain data");
    let path = args.scenes.out.join("compare.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = paired_table(&paired, names);
    print(tune, &Found { table, json, path })
}

fn study(args: &TuneArgs, choice: FilterChoice, rows: usize) -> Result<(), Error> {
    let candidate = &args.candidate;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let scenes = scenes(&candidate.scenes.scenes_dir, &candidate.scenes.scenes)?;
    let gpu = open(&choice, candidate)?;
    let out = &candidate.scenes.out;
    let (_claim, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Alone)?;
    let mut evaluator = Evaluator::new(
        gpu.as_ref(),
        &choice,
        &rendered,
        false,
        monitor(candidate.scenes.quiet),
    )?;
    let label = format!("parameters of {}", choice.filter.name);
    let found = monitor(candidate.scenes.quiet).watch(&label, |watch| {
        analyze_sensitivity(&mut evaluator, &space, rows, args.search_seed, watch)
    })?;
    let json = serde_json::to_string_pretty(&found).expect("a study is plain data");
    let path = out.join("sensitivity.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = sensitivity_table(&found);
    print(args, &Found { table, json, path })
}

/// Claims the folder for files, and reads or renders frames and truths there.
pub fn claim_and_render(
    scenes: &[(Scene, SceneBounds)],
    choice: &FilterChoice,
    args: &CandidateArgs,
    sharing: Sharing,
) -> Result<(Claim, Vec<RenderedScene>), Error> {
    let SceneArgs { out, quiet, .. } = &args.scenes;
    let render = render(args)?;
    let claim = claim(out, scenes.iter().map(|(scene, _)| scene), sharing)?;
    let alignment = choice.filter.alignment;
    let rendered = render_scenes(scenes, alignment, &render, out, monitor(*quiet))?;
    Ok((claim, rendered))
}

/// The filter with the preset to start from, for pictures of the size that is asked for.
pub fn select_candidate(args: &CandidateArgs) -> Result<FilterChoice, Error> {
    let words = [args.filter.clone()];
    let choice =
        select_filters(&words, args.from.as_deref(), &[], args.programs.programs())?.remove(0);
    Ok(choice.as_written(args.as_written).scaled_to(args.size.0))
}

/// How scenes are rendered.
pub fn render(args: &CandidateArgs) -> Result<RenderSettings, Error> {
    render_settings(
        &args.scenes,
        args.size,
        RenderSettings::default().replicates,
    )
}

/// The adapter, where the filter needs one.
pub fn open(choice: &FilterChoice, args: &CandidateArgs) -> Result<Option<Gpu>, Error> {
    let adapter = args.adapter.adapter.as_deref();
    Ok(open_gpu(
        std::slice::from_ref(choice),
        adapter,
        monitor(args.scenes.quiet),
    )?)
}
