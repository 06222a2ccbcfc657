//! Arguments of `audit`.

use std::path::PathBuf;

use clap::Args;

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
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// Folder for audit.json, and for a picture of the worst place of each object that is wrong [default: out/audit/<name of DIR>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print the audit as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
