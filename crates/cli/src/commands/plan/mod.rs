//! The command `truths plan`.

mod arguments;
mod jobs;
mod words;

use clap::ArgMatches;
use suite::Error;

pub use self::arguments::PlanArgs;
use self::jobs::list_jobs;
use super::run_plan::{apply_options, make_plan};
use crate::output::print;
use crate::tables::jobs_table;

/// Prints the jobs that a run, or a calibration, can be split into. `given` are the arguments as this command line gives them.
pub fn execute(args: &PlanArgs, given: &ArgMatches) -> Result<(), Error> {
    let (mut plan, _) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.intervals |= args.runs.is_some();
    let jobs = list_jobs(args, given, &plan)?;
    if args.json {
        let line = |job| serde_json::to_string(job).expect("a job is plain data") + "\n";
        return print(&jobs.iter().map(line).collect::<String>());
    }
    print(&jobs_table(
        jobs.iter()
            .map(|job| (job.job.as_str(), job.cpu_seconds, job.memory)),
    ))
}
