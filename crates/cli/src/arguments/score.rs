//! Arguments of `score`.

use std::path::PathBuf;

use clap::Args;

/// `shuttertruth score`
#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// The truth: truth_<alignment>.exr of `render` or `run`.
    #[arg(long, value_name = "FILE")]
    pub truth: PathBuf,
    /// The frame that the picture was made from: frame.exr of the same scene.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// The picture: OpenEXR with scene-linear R G B and optional coverage.<object>; or a PNG for display.
    #[arg(long, value_name = "FILE")]
    pub image: PathBuf,
    /// TOML file with a table [convention] that says which colour the picture has [default: scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// The folder ladder_<alignment> of `run` [default: no equivalent sub-frames].
    #[arg(long, value_name = "FOLDER")]
    pub ladder: Option<PathBuf>,
    /// Print all scores as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
