//! Arguments of `audit`.

use std::path::PathBuf;

use clap::Args;
use tracer::Location;

use super::scenes_root::{default_scenes_root, scenes_root_parser};

/// `shuttertruth audit`
#[derive(Debug, Args)]
pub struct AuditArgs {
    /// Folder of a capture, as for `ingest`: capture.toml, color.exr, velocity.exr, depth.exr; object.exr makes the audit sharper.
    #[arg(value_name = "DIR")]
    pub capture: PathBuf,
    /// TOML file with a table [convention] that says which velocity and depth the engine has [default: engine.toml in DIR].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Scene that the engine drew, with @VARIANT [default: the one that capture.toml names].
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Folder that holds the scenes; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    /// Folder for audit.json, and for a picture of the worst place of each object that is wrong [default: out/audit/<name of DIR>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print the audit as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
