//! Arguments of `export`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth export`
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Scenes: names, folders or patterns such as 'rail*', each with an optional @variant or @all.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Folder that holds the scenes.
    #[arg(long, value_name = "FOLDER", default_value = "scenes")]
    pub scenes_dir: PathBuf,
    /// Folder for glTF 2.0: each scene gets one of its own there.
    #[arg(long, value_name = "DIR", default_value = "out/gltf")]
    pub gltf: PathBuf,
    /// Write flat emissive colours and no lights: the scene as SCENE@unlit, which `run` and `render` take as well. There an engine's
    /// picture can be compared with the truth directly.
    #[arg(long)]
    pub unlit: bool,
}
