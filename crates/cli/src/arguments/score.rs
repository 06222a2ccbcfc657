//! Arguments of `score`.

use std::path::PathBuf;

use clap::Args;
use suite::Frames;
use tracer::Location;

use super::parse::{parse_frames, parse_per_second};
use super::scenes_root::{default_scenes_root, scenes_root_parser};

/// `shuttertruth score`
#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// The truth: truth_<alignment>.exr of `render` or `run`; of a sequence that of the first frame.
    #[arg(long, value_name = "FILE")]
    pub truth: PathBuf,
    /// The frame that the picture was made from: frame.exr of the same scene; of a sequence the first one.
    #[arg(long, value_name = "FILE")]
    pub frame: PathBuf,
    /// The picture: OpenEXR with scene-linear R G B and optional coverage.<object>; or a PNG for display. With --frames a folder of
    /// such pictures, 0000.exr, 0001.exr and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub image: PathBuf,
    /// TOML file with a table [convention] that says which colour the picture has [default: scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// The folder ladder_<alignment> of `run` [default: no equivalent sub-frames, and no skill
    /// unless the shutter is centred].
    #[arg(long, value_name = "FOLDER")]
    pub ladder: Option<PathBuf>,
    /// Score a sequence of N consecutive frames. Later frames and truths lie in numbered folders beside the first ones, as `run` and
    /// `render` lay them out.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = parse_frames, conflicts_with = "ladder")]
    pub frames: u32,
    /// Frames per second at which the sequence is shown. No score but JOD depends on it. A scene at a frame rate is shown at that.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = parse_per_second)]
    pub fps: f64,
    /// Folder that holds the scene, whose motion the scores of a sequence follow; built-in names the program's own [default: scenes,
    /// or built-in where there is no such folder].
    #[arg(help_heading = "Sequences", long, value_name = "FOLDER", value_parser = scenes_root_parser(), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
    /// Print all scores as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
