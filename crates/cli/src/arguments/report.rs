//! The words of `report` and `compare`, which look at what is finished.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth report`
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// run.json of a finished `run` or `check`, or its folder, where the pictures lie; or the folder of a `tune`.
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
    /// The page to write.
    #[arg(long, value_name = "FILE", required_unless_present_any = ["exr", "gallery"])]
    pub html: Option<PathBuf>,
    /// Folder for one multi-layer OpenEXR file per case: truth, output, instant, flip, velocity, coverage and more.
    #[arg(long, value_name = "DIR")]
    pub exr: Option<PathBuf>,
    /// Folder for a page of Markdown with instant, truth, best and worst filter of every scene.
    #[arg(long, value_name = "DIR")]
    pub gallery: Option<PathBuf>,
    /// Print what was written as JSON.
    #[arg(long)]
    pub json: bool,
    /// No progress bar.
    #[arg(long)]
    pub quiet: bool,
}

/// `shuttertruth compare`
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// run.json of the first run, or its folder.
    #[arg(value_name = "RUN_A")]
    pub first: PathBuf,
    /// run.json of the second run, or its folder.
    #[arg(value_name = "RUN_B")]
    pub second: PathBuf,
    /// Write the comparison as a page with the pictures that changed.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print all changes as JSON instead of the table.
    #[arg(long)]
    pub json: bool,
    /// No progress bar.
    #[arg(long)]
    pub quiet: bool,
}
