//! Options on frames, intervals and the common shutter.

use clap::Args;
use frame::Alignment;
use measure::Frames;

use super::{above_zero, frame_count};

/// Frames, intervals and the common shutter of a run.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// Frames of a sequence.
    #[command(flatten)]
    pub sequence: SequenceArgs,
    /// Measure the 95 % CI of every score, as `check` does. Cases take twice the time.
    #[arg(help_heading = "Filters", long)]
    pub intervals: bool,
    /// Shutter that every case is compared with in addition to its own [default: centred if a
    /// filter declares that, else trailing, else leading].
    #[arg(help_heading = "Filters", long, value_name = "ALIGNMENT")]
    pub common: Option<Alignment>,
}

/// Number and rate of the frames of every scene.
#[derive(Clone, Debug, Args)]
pub struct SequenceArgs {
    /// Consecutive frames to render and blur of every scene. Later frames go to numbered folders
    /// below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count())]
    pub frames: u32,
    /// Frames per second at which a sequence is shown. It changes only the score JOD. Scenes at a
    /// --frame-rate are shown at that rate.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = above_zero(1000.0))]
    pub fps: f64,
}

impl SequenceArgs {
    /// Makes the frames of a run.
    pub fn frames(&self) -> Frames {
        Frames {
            count: self.frames,
            per_second: self.fps,
        }
    }
}
