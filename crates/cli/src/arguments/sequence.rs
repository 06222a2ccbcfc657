//! Arguments that choose the frames of sequences.

use clap::Args;
use suite::Frames;

use super::parse::{above_zero, frame_count};

/// Number and rate of the frames of every scene.
#[derive(Clone, Debug, Args)]
pub struct SequenceArgs {
    /// Consecutive frames to render and blur of every scene. Later frames lie in numbered folders below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = frame_count())]
    pub frames: u32,
    /// Frames per second at which a sequence is shown. It changes no picture, and no score but JOD: times are in frames. Scenes at a
    /// --frame-rate are shown at that.
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
