//! The command `truths plan`.

mod arguments;
mod filter_words;
mod given;
mod job;
mod jobs;
mod scene_words;

use suite::Error;

pub use self::arguments::PlanArgs;
use self::jobs::list_jobs;
use super::run_plan::{apply_options, make_plan};
use crate::output::print;
use crate::tables::jobs_table;

/// Prints the jobs that a run, or a calibration, can be split into.
pub fn execute(args: &PlanArgs) -> Result<(), Error> {
    let (mut plan, _) = make_plan(&args.measure, args.measure.scenes.out.clone())?;
    apply_options(&mut plan, &args.options)?;
    plan.intervals |= args.runs.is_some();
    let jobs = list_jobs(args, &plan)?;
    if args.json {
        let lines = jobs.iter().map(|job| {
            let line = serde_json::to_string(job).expect("a job is plain data");
            line + "\n"
        });
        return print(&lines.collect::<String>());
    }
    print(&jobs_table(
        jobs.iter()
            .map(|job| (job.job.as_str(), job.cpu_seconds, job.memory)),
    ))
}
