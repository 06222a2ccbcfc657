//! Arguments of `ingest`.

use std::path::PathBuf;

use clap::Args;
use tracer::Location;

use super::scenes_root::{default_scenes_root, scenes_root_parser};

/// `shuttertruth ingest`
#[derive(Debug, Args)]
pub struct IngestArgs {
    /// Folder of a capture: capture.toml, color.exr, velocity.exr, depth.exr; optionally subframes/0000.exr and on, and
    /// blurred.exr.
    #[arg(value_name = "DIR")]
    pub capture: PathBuf,
    /// TOML file with a table [convention] that says which velocity, depth and colour the engine has [default: engine.toml in
    /// DIR].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Folder to write, which gives the scene its name [default: out/engine/<name of DIR>].
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Folder that holds the scenes, for the display exposure of the one that capture.toml names; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
}
