//! Arguments of `calibrate`.

use clap::Args;
use metrics::Metric;

use super::measure::MeasureArgs;
use super::parse::parse_runs;
use super::sequence::SequenceArgs;

/// `shuttertruth calibrate`
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub sequence: SequenceArgs,
    /// Number of runs, each with a truth of its own seed: --seed, --seed + 1, and so on.
    #[arg(help_heading = "Calibration", long, value_name = "K", default_value_t = 3, value_parser = parse_runs)]
    pub runs: u32,
    /// Adapters, by their numbers in --list-adapters or parts of their names, separated by commas [default: the fastest].
    #[arg(
        help_heading = "Calibration",
        long,
        value_delimiter = ',',
        value_name = "ADAPTERS"
    )]
    pub adapters: Vec<String>,
    /// Metrics to propose bounds for, separated by commas [default: those that have bounds, and deficit, gather_spread, label_tv_p95 and static_contamination; with --frames all of sequences too].
    #[arg(help_heading = "Calibration", long, value_delimiter = ',', value_name = "METRICS", value_parser = Metric::parse_bounded)]
    pub metrics: Vec<Metric>,
}
