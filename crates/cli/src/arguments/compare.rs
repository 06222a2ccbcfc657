//! Arguments of `compare`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth compare`
#[derive(Debug, Args)]
pub struct CompareArgs {
    /// run.json of the first run, or its folder.
    #[arg(value_name = "RUN_A")]
    pub first: PathBuf,
    /// run.json of the second run, or its folder.
    #[arg(value_name = "RUN_B")]
    pub second: PathBuf,
    /// Write the comparison as an HTML page with the pictures that changed.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Folder that holds the scenes, and bounds.toml with the margins from which a change counts.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// Print all changes as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
