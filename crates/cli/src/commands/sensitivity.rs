//! The command `tune sensitivity`.

use clap::Args;
use store::Sharing;
use suite::Error;
use tune::{Evaluator, Space, analyze_sensitivity, count_candidates};

use super::candidate::{
    candidate_render_settings, claim_and_render, load_candidate_scenes, open_candidate_gpu,
    print_expected_scoring, select_candidate,
};
use super::result::CommandResult;
use crate::arguments::{CandidateArgs, within};
use crate::output::make_monitor;
use crate::tables::sensitivity_table;

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
    #[arg(help_heading = "Study", long, value_name = "N", default_value_t = 64, value_parser = within::<usize>(0..=1_000_000))]
    pub rows: usize,
    /// Seed of the design; --seed is for renders.
    #[arg(help_heading = "Study", long, value_name = "S", default_value_t = 1)]
    pub search_seed: u64,
    /// Print sensitivity.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Studies the parameters of a filter, writes `sensitivity.json`, prints the table.
pub fn execute(args: &SensitivityArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    if args.rows < 2 {
        refuse!(
            "--rows {}; allowed: 2 or more; a single row has no variance",
            args.rows
        );
    }
    let space = Space::new(&choice.filter, choice.settings.clone(), &args.vary)?;
    let scenes = load_candidate_scenes(candidate)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    let count = count_candidates(space.axes.len(), args.rows);
    let render = candidate_render_settings(candidate)?;
    print_expected_scoring(&scenes, &render, count, f64::INFINITY);
    let (_claim, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Alone)?;
    let monitor = make_monitor();
    let mut scorer = Evaluator::new(gpu.as_ref(), &choice, &rendered, false, monitor)?;
    let label = format!("parameters of {}", choice.filter.name);
    let found = monitor.watch(&label, |watch| {
        analyze_sensitivity(&mut scorer, &space, args.rows, args.search_seed, watch)
    })?;
    let json = serde_json::to_string_pretty(&found).expect("a study is plain data");
    let path = candidate.scenes.out.join("sensitivity.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = sensitivity_table(&found);
    CommandResult { table, json, path }.print(args.json)
}
