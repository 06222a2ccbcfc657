//! Arguments that choose a candidate: a filter, its preset, and the scenes that it is scored on.

use clap::Args;
use terminal::arguments::{AdapterArgs, ProgramArgs, SceneArgs, parse_size};
use tune::Objective;

/// Choice of a filter, and of the scenes that it is scored on.
#[derive(Debug, Args)]
pub struct CandidateArgs {
    /// Filter: a name or a folder.
    #[arg(help_heading = "Filters", long, value_name = "FILTER")]
    pub filter: String,
    /// Preset to start from [default: the filter's first].
    #[arg(help_heading = "Filters", long, value_name = "PRESET")]
    pub from: Option<String>,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the
    /// preset was made for to the picture's].
    #[arg(help_heading = "Filters", long)]
    pub as_written: bool,
    /// Objectives, separated by commas: flip (always), bleed (`bleed_lateral`, neither ahead nor
    /// behind), cost.
    #[arg(help_heading = "Filters", long, value_delimiter = ',', default_value = "flip,bleed,cost", value_name = "OBJECTIVES", value_parser = parse_objective)]
    pub objective: Vec<Objective>,
    /// Picture size in pixels.
    #[arg(help_heading = "Scenes and files", long, value_name = "WxH", default_value = "320x180", value_parser = parse_size)]
    pub size: (u32, u32),
    #[command(flatten)]
    pub scenes: SceneArgs,
    #[command(flatten)]
    pub programs: ProgramArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

/// Parses an objective of a search.
fn parse_objective(text: &str) -> Result<Objective, String> {
    let mut all = Objective::ALL.iter().copied();
    let named = all.find(|objective| objective.name() == text);
    named.ok_or_else(|| "allowed: flip, bleed, cost".to_owned())
}
