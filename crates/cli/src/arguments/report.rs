//! Arguments of `report`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth report`
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// run.json of a finished `run` or `check`, or its folder; or the folder of a `tune`.
    #[arg(value_name = "RUN", default_value = "out")]
    pub run: PathBuf,
    /// HTML page to write [default: report.html beside run.json, unless --exr or --gallery is given].
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Folder for one multi-layer OpenEXR file per case: truth, output, instant, flip, velocity, coverage and more.
    #[arg(long, value_name = "DIR")]
    pub exr: Option<PathBuf>,
    /// Folder for a gallery: a page of Markdown, a contact sheet of the truths, each scene with its best and its worst filter.
    #[arg(long, value_name = "DIR")]
    pub gallery: Option<PathBuf>,
    /// Print the list of written files as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
