//! The command `tune compare`.

use clap::Args;
use store::Sharing;
use suite::Error;
use tune::{Evaluator, Objective, compare_candidates};

use super::candidate::{
    candidate_render_settings, claim_and_render, load_candidate_scenes, open_candidate_gpu,
    print_expected_scoring, select_candidate,
};
use super::result::CommandResult;
use crate::arguments::CandidateArgs;
use crate::output::make_monitor;
use crate::tables::paired_table;

#[derive(Debug, Args)]
pub struct ComparePresetsArgs {
    /// The first preset.
    #[arg(value_name = "PRESET")]
    pub first: String,
    /// The second preset.
    #[arg(value_name = "PRESET")]
    pub second: String,
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Print compare.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Scores two presets on every scene, writes `compare.json`, prints the table.
pub fn execute(args: &ComparePresetsArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = select_candidate(candidate)?;
    let presets = [&args.first, &args.second];
    let [first, second] = presets.map(|preset| choice.preset_at(preset, candidate.size.0));
    let (first, second) = (first?, second?);
    let scenes = load_candidate_scenes(candidate)?;
    let gpu = open_candidate_gpu(&choice, candidate)?;
    let render = candidate_render_settings(candidate)?;
    print_expected_scoring(&scenes, &render, 2, f64::INFINITY);
    let (_claim, rendered) = claim_and_render(&scenes, &choice, candidate, Sharing::Alone)?;
    let bleed = candidate.objective.contains(&Objective::Bleed);
    let mut scorer = Evaluator::new(gpu.as_ref(), &choice, &rendered, bleed, make_monitor())?;
    let paired = compare_candidates(&mut scorer, &first, &second)?;
    let json = serde_json::to_string_pretty(&paired).expect("a comparison is plain data");
    let path = candidate.scenes.out.join("compare.json");
    frame::write_atomically(&path, json.as_bytes())?;
    let table = paired_table(&paired, presets.map(String::as_str));
    CommandResult { table, json, path }.print(args.json)
}
