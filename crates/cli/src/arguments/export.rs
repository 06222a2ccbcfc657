//! Arguments of `export`.

use std::path::PathBuf;

use clap::Args;
use tracer::Location;

use super::scenes_root::{default_scenes_root, scenes_root_parser};

/// `shuttertruth export`
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Scenes: names, folders or patterns such as 'rail*', each with an optional @variant or @all.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Folder that holds the scenes; built-in names the program's own [default: scenes, or
    /// built-in where there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    /// Folder for glTF 2.0: each scene gets one of its own there.
    #[arg(long, value_name = "DIR", default_value = "out/gltf")]
    pub gltf: PathBuf,
    /// Write flat emissive colours and no lights: the scene as SCENE@unlit, which `run` and `render` take as well. There an engine's
    /// picture can be compared with the truth directly.
    #[arg(long)]
    pub unlit: bool,
}
