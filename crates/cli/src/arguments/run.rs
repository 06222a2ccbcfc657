//! Arguments of `run`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;
use super::measure::MeasureArgs;

/// `shuttertruth run`
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// HTML page to write [default: report.html in --out].
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print every case and all means, instead of the ranking.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub table: bool,
    /// Print run.json to standard output instead of the ranking.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
