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
    /// Write the run as one HTML page.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print run.json to standard output instead of the table.
    #[arg(long)]
    pub json: bool,
}
