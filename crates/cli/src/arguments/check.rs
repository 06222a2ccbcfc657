//! Arguments of `check`.

use std::path::PathBuf;

use clap::Args;

use super::adapter::AdapterArgs;
use super::measure::MeasureArgs;
use super::sequence::SequenceArgs;

/// Arguments that only a check that measures may have.
const MEASURING: [&str; 31] = [
    "scenes",
    "frame_rate",
    "shutter_time",
    "samples_per_pixel",
    "exposure",
    "velocity",
    "frame_sampling",
    "sky_velocity",
    "guard_band",
    "seed",
    "out",
    "filters",
    "preset",
    "set",
    "as_written",
    "size",
    "replicates",
    "velocity_format",
    "velocity_defect",
    "depth_format",
    "border",
    "buffer_size",
    "msaa",
    "camera_jitter",
    "render_scale",
    "shutter_rule",
    "depth_of_field",
    "jitter_frames",
    "frames",
    "fps",
    "adapter",
];

/// `shuttertruth check`
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Finished run to judge: its run.json, or its folder. Renders nothing and opens no adapter [default: measure now].
    #[arg(value_name = "RUN", conflicts_with_all = MEASURING)]
    pub run: Option<PathBuf>,
    /// For every broken bound of RUN, find the worst place and the known failure that the picture is most like. A check that
    /// measures always does.
    #[arg(help_heading = "Judging", long, requires = "run")]
    pub evidence: bool,
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub sequence: SequenceArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Also compare with the scores that `accept` wrote there, by the margins in bounds.toml.
    #[arg(help_heading = "Judging", long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// HTML page to write [default: report.html in --out; for a finished RUN none].
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write the result as JUnit XML.
    #[arg(help_heading = "Output", long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write GitHub's step summary ($GITHUB_STEP_SUMMARY) and print at most ten annotations.
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub github: bool,
    /// Print the result as JSON instead of text.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}
