//! Options of `run` beside those of every command that measures.

use clap::Args;
use frame::Alignment;
use suite::Frames;

use super::parse::{parse_frames, parse_per_second};

/// Frames, intervals and the common shutter of a run.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// Consecutive frames to render and blur of every scene. Later frames lie in numbered folders below the scene's own.
    #[arg(help_heading = "Sequences", long, value_name = "N", default_value_t = 1, value_parser = parse_frames)]
    pub frames: u32,
    /// Frames per second at which a sequence is shown. It changes no picture, and no score but JOD: times are in frames.
    #[arg(help_heading = "Sequences", long, value_name = "F", default_value_t = Frames::default().per_second, value_parser = parse_per_second)]
    pub fps: f64,
    /// Measure the 95 % CI of every score, as `check` does. Cases take twice the time.
    #[arg(help_heading = "Filters", long)]
    pub intervals: bool,
    /// Shutter that every case is compared with beside its own [default: centred if a filter declares that, or else trailing,
    /// or else leading].
    #[arg(help_heading = "Filters", long, value_name = "ALIGNMENT")]
    pub common: Option<Alignment>,
}

impl RunOptions {
    /// Makes the frames of a run.
    pub fn frames(&self) -> Frames {
        Frames {
            count: self.frames,
            per_second: self.fps,
        }
    }
}
