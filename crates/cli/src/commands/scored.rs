//! Arguments of `score`, and what it prints as JSON.

use std::path::PathBuf;

use clap::Args;
use frame::Truth;
use suite::Frames;

use crate::arguments::{RootArgs, above_zero, frame_count};

#[derive(Debug, Args)]
pub struct ScoreArgs {
    /// The truth: truth_<alignment>.exr of `truths render` or `run`; of a sequence that of the first frame.
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
    /// `truths render` lay them out.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count(), conflicts_with = "ladder")]
    pub frames: u32,
    /// Frames per second at which the sequence is shown. No score but JOD depends on it. A scene at a frame rate is shown at that.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = above_zero(1000.0))]
    pub fps: f64,
    #[command(flatten, next_help_heading = "Sequences")]
    pub root: RootArgs,
    /// Print all scores as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Describes what was scored as JSON.
pub fn scored_json(
    args: &ScoreArgs,
    truth: &Truth,
    notes: &[String],
    scores: impl serde::Serialize,
) -> serde_json::Value {
    serde_json::json!({
        "format": suite::FORMAT,
        "program": suite::PROGRAM,
        "image": args.image,
        "scene": truth.provenance.scene,
        "exposure": truth.shutter.exposure(),
        "alignment": truth.alignment.name(),
        "notes": notes,
        "scores": scores,
    })
}
