//! Arguments of `compare-presets`.

use clap::Args;

use super::candidate::CandidateArgs;

/// `shuttertruth compare-presets`
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
