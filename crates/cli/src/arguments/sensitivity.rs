//! Arguments of `sensitivity`.

use clap::Args;

use super::candidate::CandidateArgs;
use super::parse::{parse_effort, parse_whole};

/// `shuttertruth sensitivity`
#[derive(Debug, Args)]
pub struct SensitivityArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Parameters to study, separated by commas, each with an optional narrower range: samples=4..16 [default: all that
    /// filter.toml allows].
    #[arg(
        help_heading = "Study",
        long,
        value_delimiter = ',',
        value_name = "PARAMETERS"
    )]
    pub vary: Vec<String>,
    /// Rows of the Sobol design; 64 to 256 will do.
    #[arg(help_heading = "Study", long, value_name = "N", default_value_t = 64, value_parser = parse_effort)]
    pub rows: usize,
    /// Seed of the design; --seed is for renders.
    #[arg(help_heading = "Study", long, value_name = "S", default_value_t = 1, value_parser = parse_whole::<u64>)]
    pub search_seed: u64,
    /// Print sensitivity.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
