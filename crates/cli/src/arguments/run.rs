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
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print every case and all means, instead of the ranking.
    #[arg(long, conflicts_with = "json")]
    pub table: bool,
    /// Print run.json to standard output instead of the ranking.
    #[arg(long)]
    pub json: bool,
}
