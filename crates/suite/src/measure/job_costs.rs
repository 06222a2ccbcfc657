//! Costs of the jobs that a run can be split into: the renders of a scene, and some of its cases.

use super::estimate::{
    INTERVALS, SECONDS_PER_REPORT_PIXEL, count_pixels, estimate_case_seconds, frame_seconds,
    ladder_seconds, shared_truths, truth_seconds,
};
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use crate::render::ladders::needed_rungs;

/// Cores that the usual time of a case was measured on, all of which the software adapter takes.
const CASE_CORES: f64 = 2.0;
/// CPU time to open an adapter and to compile kernels, in seconds, and to prepare a truth, in usual cases. Measured with llvmpipe on
/// two cores of a server.
const START_SECONDS: f64 = 0.3;
const START_CASES: f64 = 2.0;

/// Expected cost of a job, on any number of cores: a truth may take three times as long, references take a fifth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JobCost {
    /// Time on one core, in seconds.
    pub cpu_seconds: f64,
    /// Bytes of memory at the most.
    pub memory: u64,
}

/// Costs of the jobs of one scene of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneJobs {
    /// Frames, truths and ladders; none for what an engine drew.
    pub render: Option<JobCost>,
    /// Number of all references.
    pub references: usize,
    /// Number of cases of each filter preset.
    pub inputs: usize,
    /// CPU time of each case, in seconds.
    case_seconds: f64,
    /// CPU time before the first case, in seconds.
    start_seconds: f64,
    /// Bytes of memory at the most.
    memory: u64,
}

impl SceneJobs {
    /// Returns the cost of a process that measures some cases of the scene.
    pub fn cases(&self, count: usize) -> JobCost {
        JobCost {
            cpu_seconds: self.start_seconds + count as f64 * self.case_seconds,
            memory: self.memory,
        }
    }
}

/// Estimates the jobs of every scene, where nothing is kept. Measures nothing, so that a plan is the same each time.
pub fn estimate_jobs(plan: &RunPlan) -> Vec<SceneJobs> {
    let render = &plan.render;
    let frames = f64::from(plan.frames.count);
    let truths = plan.alignments().len();
    let threads = rayon::current_num_threads() as f64;
    let ladders = plan.alignments().into_iter().map(|alignment| {
        let rungs = needed_rungs(alignment, plan.ladders).len();
        ladder_seconds(render, rungs)
    });
    let renders = frame_seconds(render)
        + shared_truths(truths) * truth_seconds(render)
        + ladders.sum::<f64>();
    let case = CASE_CORES * estimate_case_seconds(render);
    let intervals = if plan.intervals { INTERVALS } else { 1.0 };
    let all = plan.all_scenes().into_iter();
    let jobs = all.map(|scene| {
        let memory = scene.memory(render, truths, plan.inputs.len());
        let cpu_seconds = frames * threads * renders;
        let planned = PlannedCase::all(plan, &plan.filters, scene);
        let references = planned.iter().filter(|case| case.id.is_reference);
        SceneJobs {
            render: (scene.traced()).map(|_| JobCost {
                cpu_seconds,
                memory,
            }),
            references: references.count(),
            inputs: plan.inputs.len(),
            case_seconds: frames * intervals * case,
            start_seconds: START_SECONDS + frames * START_CASES * case,
            memory,
        }
    });
    jobs.collect()
}

/// Estimates the page of a run with this many cases.
pub fn estimate_report(plan: &RunPlan, cases: usize) -> JobCost {
    let seconds = cases as f64 * count_pixels(&plan.render) * SECONDS_PER_REPORT_PIXEL;
    let memory = plan
        .all_scenes()
        .into_iter()
        .map(|scene| scene.memory(&plan.render, 1, 1));
    JobCost {
        cpu_seconds: CASE_CORES * seconds,
        memory: memory.max().unwrap_or(0),
    }
}
