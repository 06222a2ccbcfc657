//! Arguments of `blur`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;
use super::parse::{parse_exposure, parse_frames, parse_whole};
use super::programs::ProgramArgs;

/// `shuttertruth blur`
#[derive(Debug, Args)]
pub struct BlurArgs {
    /// Filter: a name or a folder, with an optional :preset.
    #[arg(long, value_name = "FILTER")]
    pub filter: String,
    /// Preset [default: the filter's first].
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Override a parameter; repeatable.
    #[arg(long, value_name = "FILTER.PARAMETER=VALUE")]
    pub set: Vec<String>,
    /// Keep lengths in pixels as the preset has them [default: scale them from the width that the preset was made for to the
    /// picture's].
    #[arg(long)]
    pub as_written: bool,
    /// OpenEXR file with the channels R G B, Z, velocity.X, velocity.Y. With --frames that of the first frame, as `run` and `render`
    /// lay them out, or a folder of 0000.exr, 0001.exr and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub frame: PathBuf,
    /// TOML file with a table [convention] that says which velocity, depth and colour the frame has, and the picture gets
    /// [default: pixels per frame, metres, scene-linear].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// Exposure in frames [default: the file's attribute "exposure"].
    #[arg(long, value_name = "E", value_parser = parse_exposure)]
    pub exposure: Option<f64>,
    /// Frame number, which seeds the filter's noise; of a sequence that of the first frame.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = parse_whole::<u32>)]
    pub frame_index: u32,
    /// Blur N consecutive frames, each with the next frame number, and with the frame before for filters with history.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = parse_frames)]
    pub frames: u32,
    /// OpenEXR file to write; with --frames a folder for 0000.exr, 0001.exr and so on [default: out/blurred.exr, or out/blurred].
    #[arg(short, long, value_name = "FILE|DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub programs: ProgramArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}
