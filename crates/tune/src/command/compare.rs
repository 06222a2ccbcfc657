//! The command `tune compare`.

use clap::Args;
use measure::Error;
use terminal::result::write_result;

use super::CandidateArgs;
use crate::comparison::compare_candidates;
use crate::table::paired_table;
use crate::trial::Objective;

/// Arguments of `tune compare`.
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// The first preset.
    #[arg(value_name = "PRESET")]
    pub first: String,
    /// The second preset.
    #[arg(value_name = "PRESET")]
    pub second: String,
    /// Filter and scenes.
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// Print compare.json instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Scores two presets on every scene, writes `compare.json`, prints the table.
pub fn execute(args: &CompareArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = candidate.select()?;
    let presets = [&args.first, &args.second];
    let [first, second] = presets.map(|preset| choice.preset_at(preset, candidate.size.width));
    let (first, second) = (first?, second?);
    let bleed = candidate.objective.contains(&Objective::Bleed);
    let paired = candidate.score(&choice, bleed, Some(2), |evaluator| {
        compare_candidates(evaluator, &first, &second)
    })?;
    let path = candidate.scenes.out.join("compare.json");
    let table = paired_table(&paired, presets.map(String::as_str));
    write_result(&path, &paired, table, args.json)
}
