//! Arguments of `compare`.

use std::path::PathBuf;

use clap::Args;
use tracer::Location;

use super::scenes_root::{default_scenes_root, scenes_root_parser};

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
    /// Folder that holds the scenes, and bounds.toml with the margins from which a change counts; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    /// Print all changes as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
