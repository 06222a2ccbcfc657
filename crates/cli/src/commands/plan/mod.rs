//! The command `truths plan`.

mod jobs;
mod words;

use std::path::PathBuf;

use clap::{ArgMatches, Args};
use metrics::Metric;
use suite::Error;

use self::jobs::list_jobs;
use super::run_plan::{apply_options, make_plan};
use crate::arguments::{AdapterArgs, MeasureArgs, RunOptions, within};
use crate::output::print;
use crate::tables::jobs_table;

#[derive(Debug, Args)]
pub struct PlanArgs {
    #[command(flatten)]
    pub measure: MeasureArgs,
    #[command(flatten)]
    pub adapter: AdapterArgs,
    #[command(flatten)]
    pub options: RunOptions,
    /// Plan `calibrate --runs K`, instead of `run`.
    #[arg(help_heading = "Jobs", long, value_name = "K", value_parser = within::<u32>(2..=100), conflicts_with_all = ["frames", "fps", "intervals", "common", "adapter"])]
    pub runs: Option<u32>,
    /// Metrics of the calibration, separated by commas [default: those that have bounds, and deficit, gather_spread, label_tv_p95 and static_contamination].
    #[arg(help_heading = "Jobs", long, value_delimiter = ',', value_name = "METRICS", value_parser = parse_frame_metric, requires = "runs")]
    pub metrics: Vec<Metric>,
    /// Folder for the truths and the parts of all jobs [default: parts in --out].
    #[arg(help_heading = "Jobs", long, value_name = "DIR")]
    pub parts: Option<PathBuf>,
    /// Print one line of JSON per job: job, arguments, inputs, outputs, cpu_seconds, and memory in bytes.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Prints the jobs that a run, or a calibration, can be split into. `given` are the arguments as this command line gives them.
pub fn execute(args: &PlanArgs, given: &ArgMatches) -> Result<(), Error> {
    let (mut plan, _) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.intervals |= args.runs.is_some();
    let jobs = list_jobs(
        &args.measure,
        args.parts.as_deref(),
        args.runs,
        given,
        &plan,
    )?;
    if args.json {
        let line = |job| serde_json::to_string(job).expect("a job is plain data") + "\n";
        return print(&jobs.iter().map(line).collect::<String>());
    }
    print(&jobs_table(
        jobs.iter()
            .map(|job| (job.job.as_str(), job.cpu_seconds, job.memory)),
    ))
}

/// Parses the name of a score of single frames, which calibrations are planned for.
fn parse_frame_metric(text: &str) -> Result<Metric, String> {
    match Metric::parse_bounded(text)? {
        Metric::Sequence(_) => {
            Err("is a score of a sequence, and single frames are planned".to_owned())
        }
        metric => Ok(metric),
    }
}
