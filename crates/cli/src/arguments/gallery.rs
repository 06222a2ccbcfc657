//! Arguments of `gallery`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth gallery`
#[derive(Debug, Args)]
pub struct GalleryArgs {
    /// run.json of a finished `run` or `check`, or its folder, where the pictures lie.
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
    /// Folder for README.md and the pictures.
    #[arg(long, value_name = "DIR", default_value = "gallery")]
    pub out: PathBuf,
}
