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
}
