//! The words of `tune`, `evaluate` and `serve`.

use std::path::PathBuf;

use clap::Args;
use suite::Objective;

use super::{AdapterArgs, ProgramArgs, SceneArgs};
use crate::arguments::values::{effort, ratio, size};

/// `shuttertruth tune`
#[derive(Debug, Args)]
pub struct TuneArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Parameters to change, separated by commas, each with an optional narrower range: samples=4..16 [default: every one
    /// that its filter.toml does not mark as not tunable].
    #[arg(long, value_delimiter = ',', value_name = "PARAMETERS")]
    pub vary: Vec<String>,
    /// How many candidates to try, those of an interrupted run included.
    #[arg(long, value_name = "N", default_value_t = 400, value_parser = effort)]
    pub budget: usize,
    /// Begin no more candidates after so many minutes.
    #[arg(long, value_name = "M", value_parser = minutes)]
    pub minutes: Option<f64>,
    /// Choose nothing that takes more GPU time than so many times the start's.
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub cost_at_most: Option<f64>,
    /// Choose nothing whose lateral bleed on its worst scene is more than so many times the start's on its own, and 0.01 px.
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub bleed_at_most: Option<f64>,
    /// Run every candidate on every scene, however bad it is.
    #[arg(long)]
    pub no_race: bool,
    /// Seed of the search; --seed is that of the renders.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub search_seed: u64,
    /// Held-out scenes, evaluated once at the end; each evaluation is counted.
    #[arg(long, value_delimiter = ',', value_name = "SCENES")]
    pub sealed: Vec<String>,
    /// Picture size of the held-out scenes.
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = size)]
    pub sealed_size: (u32, u32),
    /// Samples per pixel of the held-out scenes' truths.
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub sealed_samples_per_pixel: u32,
    /// Tune nothing: tell which parameters matter, by Sobol indices from so many rows; 64 to 256 will do. A row scores
    /// two candidates, and one more for each parameter.
    #[arg(long, value_name = "ROWS", value_parser = effort, conflicts_with_all = ["sealed", "minutes", "compare"])]
    pub sobol: Option<usize>,
    /// Tune nothing: compare two presets over the scenes.
    #[arg(long, value_delimiter = ',', num_args = 1, value_name = "PRESET,PRESET", conflicts_with_all = ["vary", "sealed", "minutes"])]
    pub compare: Vec<String>,
    /// Print what is written as JSON instead of the table: tune.json, sensitivity.json or compare.json.
    #[arg(long)]
    pub json: bool,
}

/// `shuttertruth evaluate`
#[derive(Debug, Args)]
pub struct EvaluateArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// JSON file with the parameters that differ from the preset: {"samples": 12}
    #[arg(long, value_name = "FILE")]
    pub params: PathBuf,
}

/// `shuttertruth serve`
#[derive(Debug, Args)]
pub struct ServeArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
}

/// What is scored, and on what.
#[derive(Debug, Args)]
pub struct CandidateArgs {
    /// Filter: a name or a folder.
    #[arg(long, value_name = "FILTER")]
    pub filter: String,
    /// The preset to start from [default: the filter's first].
    #[arg(long, value_name = "PRESET")]
    pub from: Option<String>,
    /// Presets keep their constants in pixels as published; otherwise they are scaled from the width that their author had in
    /// mind to the picture's.
    #[arg(long)]
    pub as_written: bool,
    /// What is measured, separated by commas: flip (always), bleed (`bleed_lateral`, not ahead or behind), cost.
    #[arg(long, value_delimiter = ',', default_value = "flip,bleed,cost", value_name = "OBJECTIVES", value_parser = objective)]
    pub objective: Vec<Objective>,
    /// Picture size in pixels.
    #[arg(long, value_name = "WxH", default_value = "320x180", value_parser = size)]
    pub size: (u32, u32),
    #[command(flatten)]
    pub scenes: SceneArgs,
    #[command(flatten)]
    pub programs: ProgramArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

fn objective(word: &str) -> Result<Objective, String> {
    (Objective::ALL.into_iter())
        .find(|objective| objective.name() == word)
        .ok_or_else(|| "allowed: flip, bleed, cost".to_owned())
}

fn minutes(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(minutes) if minutes > 0.0 && minutes <= 1e6 => Ok(minutes),
        _ => Err("allowed is a number above 0".to_owned()),
    }
}
