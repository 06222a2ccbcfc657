//! Arguments of `tune`.

use clap::Args;

use super::candidate::CandidateArgs;
use super::parse::{parse_effort, parse_minutes, parse_ratio, parse_size, parse_whole};

/// `shuttertruth tune`
#[derive(Debug, Args)]
pub struct TuneArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Parameters to change, separated by commas, each with an optional narrower range: samples=4..16 [default: all that
    /// filter.toml allows].
    #[arg(
        help_heading = "Search",
        long,
        value_delimiter = ',',
        value_name = "PARAMETERS"
    )]
    pub vary: Vec<String>,
    /// Candidates to try, including those of an interrupted run.
    #[arg(help_heading = "Search", long, value_name = "N", default_value_t = 400, value_parser = parse_effort)]
    pub budget: usize,
    /// Minutes after which no candidate begins.
    #[arg(help_heading = "Search", long, value_name = "M", value_parser = parse_minutes)]
    pub minutes: Option<f64>,
    /// Upper limit on GPU time, relative to the start's.
    #[arg(help_heading = "Search", long, value_name = "RATIO", value_parser = parse_ratio)]
    pub cost_at_most: Option<f64>,
    /// Upper limit on lateral bleed of the worst scene, relative to the start's; 0.01 px is always allowed.
    #[arg(help_heading = "Search", long, value_name = "RATIO", value_parser = parse_ratio)]
    pub bleed_at_most: Option<f64>,
    /// Run every candidate on every scene, even a bad one.
    #[arg(help_heading = "Search", long)]
    pub no_race: bool,
    /// Seed of the search; --seed is for renders.
    #[arg(help_heading = "Search", long, value_name = "S", default_value_t = 1, value_parser = parse_whole::<u64>)]
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
    pub held_out_size: (u32, u32),
    /// Mean samples per pixel of the held-out scenes' truths.
    #[arg(
        help_heading = "Held-out scenes",
        long,
        value_name = "N",
        default_value_t = 256,
        value_parser = parse_whole::<u32>
    )]
    pub held_out_samples_per_pixel: u32,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_sealed)]
    sealed: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_sealed_size)]
    sealed_size: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_sealed_samples)]
    sealed_samples_per_pixel: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_sobol)]
    morris: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_sobol)]
    sobol: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, value_parser = refuse_compare)]
    compare: Option<String>,
    /// Print tune.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

fn refuse_sealed(scenes: &str) -> Result<String, String> {
    Err(format!("it is called --held-out now: --held-out {scenes}"))
}

fn refuse_sealed_size(size: &str) -> Result<String, String> {
    Err(format!(
        "it is called --held-out-size now: --held-out-size {size}"
    ))
}

fn refuse_sealed_samples(samples: &str) -> Result<String, String> {
    Err(format!(
        "it is called --held-out-samples-per-pixel now: --held-out-samples-per-pixel {samples}"
    ))
}

fn refuse_sobol(_: &str) -> Result<String, String> {
    Err(
        "it is a command of its own now: shuttertruth sensitivity --filter FILTER --rows N"
            .to_owned(),
    )
}

fn refuse_compare(_: &str) -> Result<String, String> {
    Err(
        "it is a command of its own now: shuttertruth compare-presets --filter FILTER PRESET PRESET"
            .to_owned(),
    )
}
