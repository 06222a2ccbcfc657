//! Arguments of `run`.

use std::path::PathBuf;

use clap::Args;
use suite::Frames;

use super::adapter::AdapterArgs;
use super::measure::MeasureArgs;
use super::parse::{parse_frames, parse_per_second};

/// `shuttertruth run`
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Consecutive frames to render and blur of every scene. Later frames lie in numbered folders below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = parse_frames)]
    pub frames: u32,
    /// Frames per second at which a sequence is shown. It changes no picture, and no score but JOD: times are in frames.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = parse_per_second)]
    pub fps: f64,
    /// HTML page to write [default: report.html in --out].
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print every case and all means, instead of the ranking.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub table: bool,
    /// Print run.json to standard output instead of the ranking.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
