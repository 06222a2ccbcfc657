//! Arguments of `run`.

use std::path::PathBuf;

use clap::Args;
use suite::Part;

use super::adapter::AdapterArgs;
use super::measure::MeasureArgs;
use super::parse::parse_named;
use super::run_options::RunOptions;

/// `shuttertruth run`
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    #[command(flatten)]
    pub options: RunOptions,
    /// Measure a part of a run that `merge` joins with others. Writes run.json and pictures, but no report.
    #[arg(help_heading = "Filters", long, value_name = "PART", value_parser = parse_named(Part::PARTS, Part::name, Part::help), conflicts_with_all = ["html", "table"])]
    pub part: Option<Part>,
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
