//! Arguments of the command `score`.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use frame::MAX_STOPS;
use measure::{Frames, printable};
use terminal::arguments::{RootArgs, above_zero, frame_count};

/// Arguments of `score`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("against").required(true).args(["truth", "reference"]))]
pub struct ScoreArgs {
    /// The picture: OpenEXR or HDR with scene-linear R G B and optional coverage.<object>, or a PNG
    /// or JPEG for display. With --frames a folder of such pictures, 0000.exr, 0001.exr and so on.
    #[arg(long, value_name = "FILE|DIR")]
    pub image: PathBuf,
    /// The truth: truth_<alignment>.exr of `truths render` or `run`; for a sequence, the first
    /// frame's.
    #[arg(long, value_name = "FILE", requires = "frame")]
    pub truth: Option<PathBuf>,
    /// Any picture of the same size instead of a truth: OpenEXR, HDR, PNG or JPEG. Scores that need
    /// more than two pictures are left out.
    #[arg(long, value_name = "FILE")]
    pub reference: Option<PathBuf>,
    /// The frame that the picture was made from. With --truth, frame.exr of the same scene; for a
    /// sequence, the first one. With --reference, any sharp picture: it adds scores of no blur.
    #[arg(long, value_name = "FILE")]
    pub frame: Option<PathBuf>,
    /// OpenEXR with screen motion, velocity.X velocity.Y: it adds scores of what moves, which is
    /// all that crosses a pixel within half a frame.
    #[arg(
        help_heading = "With --reference",
        long,
        value_name = "FILE",
        conflicts_with = "truth"
    )]
    pub velocity: Option<PathBuf>,
    /// Two OpenEXR files with coverage.<object>, the reference's and the picture's: they add scores
    /// of labels.
    #[arg(
        help_heading = "With --reference",
        long,
        value_name = "FILE",
        num_args = 2,
        conflicts_with = "truth"
    )]
    pub mattes: Vec<PathBuf>,
    /// Display exposure of scene-linear pictures, in stops.
    #[arg(
        help_heading = "With --reference",
        long,
        value_name = "STOPS",
        allow_negative_numbers = true,
        default_value_t = 0.0, value_parser = parse_stops, conflicts_with = "truth"
    )]
    pub stops: f32,
    /// TOML file with a table [convention] that says which colour and velocity the files have
    /// [default: scene-linear; pixels per frame].
    #[arg(long, value_name = "FILE")]
    pub convention: Option<PathBuf>,
    /// The folder ladder_<alignment> of `run` [default: no equivalent sub-frames, and no skill
    /// unless the shutter is centred].
    #[arg(long, value_name = "FOLDER", conflicts_with = "reference")]
    pub ladder: Option<PathBuf>,
    /// Score a sequence of N consecutive frames, with files as `run` and `truths render` write
    /// them.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count(), conflicts_with_all = ["ladder", "reference", "html"])]
    pub frames: u32,
    /// Frames per second at which the sequence is shown. It changes only the score JOD. A scene at
    /// a frame rate is shown at that rate.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = above_zero(1000.0))]
    pub fps: f64,
    /// Folder of scenes.
    #[command(flatten, next_help_heading = "Sequences")]
    pub root: RootArgs,
    /// HTML page to write: both pictures and the error map, under a slider or blinking.
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Print all scores as JSON instead of the table.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Largest display exposure of two pictures, in stops: HDR-FLIP looks two stops further.
const MOST_STOPS: f32 = MAX_STOPS - 2.0;

fn parse_stops(text: &str) -> Result<f32, String> {
    let stops: f32 = text.parse().map_err(|_| "a number is needed".to_owned())?;
    if stops.abs() <= MOST_STOPS {
        Ok(stops)
    } else {
        Err(format!("allowed: from -{MOST_STOPS} to {MOST_STOPS}"))
    }
}

impl ScoreArgs {
    /// Returns the files of truth and frame.
    pub fn truth_files(&self) -> [&Path; 2] {
        let named = [&self.truth, &self.frame];
        named.map(|file| {
            file.as_deref()
                .expect("the command line requires it without --reference")
        })
    }
}

/// Names a file without its folder, as it can be printed.
pub fn name_file(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    printable(&name.to_string_lossy()).into_owned()
}
