//! The words of `check`, `accept` and `calibrate`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use metrics::Metric;

use super::{AdapterArgs, MeasureArgs};
use crate::arguments::values::{glob, runs};

/// Options of a check that measures, which a finished run has been made with.
const MEASURING: [&str; 21] = [
    "scenes",
    "samples_per_pixel",
    "exposure",
    "velocity",
    "color",
    "sky_velocity",
    "guard_band",
    "seed",
    "out",
    "filters",
    "filter",
    "preset",
    "set",
    "as_written",
    "size",
    "replicates",
    "velocity_format",
    "depth_format",
    "border",
    "jitter_frames",
    "adapter",
];

/// `shuttertruth check`
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// A finished run to judge: its run.json, or its folder. Nothing is rendered, and no adapter is opened [default: run the
    /// cases and judge them].
    #[arg(value_name = "RUN", conflicts_with_all = MEASURING)]
    pub run: Option<PathBuf>,
    /// Look for the worst place of every bound that RUN does not keep, and for the wrong blur that its picture is like; a
    /// check that measures always does.
    #[arg(long, requires = "run")]
    pub evidence: bool,
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    /// Compare with the scores that `accept` wrote there, too: no worse by more than the margins in bounds.toml?
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Write the run as one page, as `report` does, whether the check passes or not.
    #[arg(long, value_name = "FILE")]
    pub html: Option<PathBuf>,
    /// Write the result as JUnit XML.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Write GitHub's step summary ($GITHUB_STEP_SUMMARY) and print annotations, ten at most.
    #[arg(long, conflicts_with = "json")]
    pub github: bool,
    /// Print the result as JSON instead of text.
    #[arg(long)]
    pub json: bool,
}

/// `shuttertruth accept`
#[derive(Debug, Args)]
pub struct AcceptArgs {
    /// Folder of the finished run: what --out was for `run` or `check`.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Why these scores are right, in one line.
    #[arg(long, value_name = "TEXT")]
    pub reason: String,
    /// Which cases, by scene/filter:preset, such as 'fan/*' or '*/jump_flood:*' [default: all; others are forgotten].
    #[arg(long, value_name = "GLOB", value_parser = glob)]
    pub only: Option<glob::Pattern>,
    /// The file to write, or to change with --only.
    #[arg(long, value_name = "FILE", default_value = "base.json")]
    pub baseline: PathBuf,
    /// Accept although this is CI (CI=true), or the adapter another class than the baseline's.
    #[arg(long)]
    pub force: bool,
}

/// `shuttertruth calibrate`
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    /// How many times, each with a truth of another seed: --seed, --seed + 1 ..
    #[arg(long, value_name = "K", default_value_t = 3, value_parser = runs)]
    pub runs: u32,
    /// Adapters, separated by commas, by their numbers in --list-adapters or parts of their names [default: the fastest].
    #[arg(long, value_delimiter = ',', value_name = "ADAPTERS")]
    pub adapters: Vec<String>,
    /// Metrics to propose limits for, separated by commas [default: those that have bounds].
    #[arg(long, value_delimiter = ',', value_name = "METRICS", value_parser = Metric::from_str)]
    pub metrics: Vec<Metric>,
}
