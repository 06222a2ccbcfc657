//! The command `tune sensitivity`.

use clap::Args;
use measure::Error;
use terminal::arguments::within;
use terminal::output::make_monitor;
use terminal::result::write_result;

use super::CandidateArgs;
use crate::sensitivity::{analyze_sensitivity, count_candidates};
use crate::space::Space;
use crate::table::sensitivity_table;

/// Arguments of `tune sensitivity`.
#[derive(Debug, Args)]
pub struct SensitivityArgs {
    /// Filter and scenes.
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Parameters to study, separated by commas, each with an optional narrower range:
    /// samples=4..16 [default: all that filter.toml allows].
    #[arg(
        help_heading = "Study",
        long,
        value_delimiter = ',',
        value_name = "PARAMETERS"
    )]
    pub vary: Vec<String>,
    /// Rows of the Sobol design; 64 to 256 will do.
    #[arg(help_heading = "Study", long, value_name = "N", default_value_t = 64, value_parser = within::<usize>(2..=1_000_000))]
    pub rows: usize,
    /// Seed of the design; --seed is for renders.
    #[arg(help_heading = "Study", long, value_name = "S", default_value_t = 1)]
    pub search_seed: u64,
    /// Print sensitivity.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Studies a filter's parameters, writes `sensitivity.json`, and prints the table.
pub fn execute(args: &SensitivityArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = candidate.select()?;
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let count = count_candidates(&space, args.rows);
    let label = format!("parameters of {}", choice.filter.name);
    let sensitivity = candidate.score(&choice, false, Some(count), |evaluator| {
        make_monitor().watch(&label, |watch| {
            analyze_sensitivity(evaluator, &space, args.rows, args.search_seed, watch)
        })
    })?;
    let path = candidate.scenes.out.join("sensitivity.json");
    write_result(
        &path,
        &sensitivity,
        &sensitivity_table(&sensitivity),
        args.json,
    )
}
