//! Options of `run` beside those of every command that measures.

use clap::Args;
use frame::Alignment;

use super::SequenceArgs;

/// Frames, intervals and the common shutter of a run.
#[derive(Debug, Args)]
pub struct RunOptions {
    #[command(flatten)]
    pub sequence: SequenceArgs,
    /// Measure the 95 % CI of every score, as `check` does. Cases take twice the time.
    #[arg(help_heading = "Filters", long)]
    pub intervals: bool,
    /// Shutter that every case is compared with beside its own [default: centred if a filter declares that, or else trailing,
    /// or else leading].
    #[arg(help_heading = "Filters", long, value_name = "ALIGNMENT")]
    pub common: Option<Alignment>,
}
