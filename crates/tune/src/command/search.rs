//! The command `tune search`.

use std::time::{Duration, Instant};

use clap::Args;
use frame::{FileError, Size};
use measure::{Error, FilterChoice, Sharing, lock_folder};
use terminal::arguments::{above_zero, parse_ratio, parse_samples, parse_size, within};
use terminal::output::{is_quiet, make_monitor, print_error};
use terminal::result::{write_json, write_result};
use terminal::selection::load_scenes;
use tracer::{Progress, RenderSettings};

use super::candidate::{CandidateArgs, print_expected_scoring};
use crate::advice::Advice;
use crate::options::{TuneOptions, interleave_families};
use crate::preset::tuned_preset_toml;
use crate::space::Space;
use crate::table::{advice_text, tuning_table};
use crate::tuning::{Tuning, tune};

/// Arguments of `tune search`.
#[derive(Debug, Args)]
pub struct SearchArgs {
    /// Filter and scenes.
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Parameters to change, separated by commas, each with an optional narrower range:
    /// samples=4..16 [default: all that filter.toml allows].
    #[arg(
        help_heading = "Search",
        long,
        value_delimiter = ',',
        value_name = "PARAMETERS"
    )]
    pub vary: Vec<String>,
    /// Candidates to try, including those of an interrupted run.
    #[arg(help_heading = "Search", long, value_name = "N", default_value_t = 400, value_parser = within::<usize>(1..=1_000_000))]
    pub budget: usize,
    /// Minutes after which no candidate begins.
    #[arg(help_heading = "Search", long, value_name = "M", value_parser = above_zero(1e6))]
    pub minutes: Option<f64>,
    /// Upper limit on GPU time, relative to the start's.
    #[arg(help_heading = "Search", long, value_name = "RATIO", value_parser = parse_ratio)]
    pub cost_at_most: Option<f64>,
    /// Upper limit on lateral bleed of the worst scene, relative to the start's; 0.01 px is always
    /// allowed.
    #[arg(help_heading = "Search", long, value_name = "RATIO", value_parser = parse_ratio)]
    pub bleed_at_most: Option<f64>,
    /// Run every candidate on every scene, even a bad one.
    #[arg(help_heading = "Search", long)]
    pub no_race: bool,
    /// Seed of the search; --seed is for renders.
    #[arg(help_heading = "Search", long, value_name = "S", default_value_t = 1)]
    pub search_seed: u64,
    /// Held-out scenes, evaluated once at the end; every evaluation is recorded.
    #[arg(
        help_heading = "Held-out scenes",
        long,
        value_delimiter = ',',
        value_name = "SCENES"
    )]
    pub held_out: Vec<String>,
    /// Picture size of the held-out scenes.
    #[arg(help_heading = "Held-out scenes", long, value_name = "WxH", default_value = "320x180", value_parser = parse_size)]
    pub held_out_size: Size,
    /// Mean samples per pixel of the held-out scenes' truths.
    #[arg(
        help_heading = "Held-out scenes",
        long,
        value_name = "N",
        default_value_t = 256,
        value_parser = parse_samples
    )]
    pub held_out_samples_per_pixel: u32,
    /// Print tune.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Tunes a filter, writes `journal.jsonl`, `tune.json` and the chosen values, and prints the table.
pub fn execute(args: &SearchArgs) -> Result<(), Error> {
    let options = make_options(args, args.candidate.select()?)?;
    options.check()?;
    let gpu = args.candidate.open_gpu(&options.choice)?;
    let scenes = options.scenes.iter().chain(&options.held_out);
    let _lock = lock_folder(
        &options.out,
        scenes.map(|known| &known.scene),
        Sharing::Alone,
    )?;
    // A race drops many candidates early.
    let limit = (options.time).map_or(f64::INFINITY, |time| time.as_secs_f64());
    print_expected_scoring(&options.scenes, &options.render, options.budget, limit);
    let began = Instant::now();
    let label = format!("tuning {}", options.choice.filter.name);
    let tuning = options.monitor.watch(&label, |watch| {
        tune(&options, gpu.as_ref(), |trial| {
            // An interrupted loop ends itself.
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
    write_tuning(&tuning, &options, args.json)
}

fn make_options(args: &SearchArgs, choice: FilterChoice) -> Result<TuneOptions, Error> {
    let candidate = &args.candidate;
    let scene_args = &candidate.scenes;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let held_out = match args.held_out.as_slice() {
        [] => Vec::new(),
        words => load_scenes(&scene_args.root.scenes_dir, words, Some(args.held_out_size))?,
    };
    let mut open = candidate.load_scenes()?;
    if scene_args.written().is_empty() {
        // "All scenes" excludes the held-out ones.
        open.retain(|open| held_out.iter().all(|held| held.scene.id != open.scene.id));
    }
    let render = candidate.render_settings();
    Ok(TuneOptions {
        choice,
        space,
        scenes: interleave_families(open),
        held_out,
        render,
        held_out_render: RenderSettings {
            width: args.held_out_size.width,
            height: args.held_out_size.height,
            samples_per_pixel: args.held_out_samples_per_pixel,
            ..render
        },
        objectives: candidate.objective.clone(),
        cost_at_most: args.cost_at_most,
        bleed_at_most: args.bleed_at_most,
        budget: args.budget,
        time: args
            .minutes
            .map(|minutes| Duration::from_secs_f64(60.0 * minutes)),
        race: !args.no_race,
        seed: args.search_seed,
        out: scene_args.out.clone(),
        monitor: make_monitor(),
    })
}

/// Writes tune.json and params.json, and preset.toml if the choice is an improvement (else removes
/// an earlier tuning's); prints the table.
fn write_tuning(tuning: &Tuning, options: &TuneOptions, as_json: bool) -> Result<(), Error> {
    let path = |name: &str| options.out.join(name);
    write_json(&path("params.json"), &tuning.values)?;
    let preset = path("preset.toml");
    match tuning.advice() {
        Advice::Take => {
            let text = tuned_preset_toml(tuning, options);
            frame::write_atomically(&preset, text.as_bytes())?;
        }
        _ if preset.exists() => std::fs::remove_file(&preset)
            .map_err(|source| FileError::io(&preset, "remove", source))?,
        _ => {}
    }
    let advice = advice_text(tuning).plain();
    let table = tuning_table(tuning) + "\n" + advice.trim_end();
    write_result(&path("tune.json"), tuning, table, as_json)
}
