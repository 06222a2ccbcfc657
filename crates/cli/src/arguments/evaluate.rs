//! Arguments of `evaluate`.

use std::path::PathBuf;

use clap::Args;

use super::candidate::CandidateArgs;

/// `shuttertruth evaluate`
#[derive(Debug, Args)]
pub struct EvaluateArgs {
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// JSON file with the parameters that differ from the preset: {"samples": 12}
    #[arg(help_heading = "Filters", long, value_name = "FILE")]
    pub params: PathBuf,
}
