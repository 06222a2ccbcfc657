//! Runs: scene after scene, measured by one plan.

use filters::Gpu;
use tracer::{Progress, Watch};

use super::estimate::{RunEstimate, estimate_run_roughly};
use super::plan::RunPlan;
use super::scene::SceneContext;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::{FORMAT, Run};
use crate::stats::overall::overall;
use crate::{Error, PROGRAM};

/// Measures as [`measure_scenes_as_expected`] does, without an estimate made before.
pub fn measure_scenes(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    command: Vec<String>,
) -> Result<Run, Error> {
    measure_scenes_as_expected(plan, gpu, command, &estimate_run_roughly(plan, gpu))
}

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself. Reads back what an earlier run
/// measured of the same inputs and left there. `gpu` is what [`open_gpu`](crate::open_gpu) opened for the plan's filters. The progress
/// of all scenes follows the estimate.
pub fn measure_scenes_as_expected(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    command: Vec<String>,
    estimate: &RunEstimate,
) -> Result<Run, Error> {
    // The steps of a single scene show all of the progress.
    let scenes = plan.all_scenes().len();
    let monitor = match scenes {
        1 => plan.monitor.without_progress(),
        _ => plan.monitor,
    };
    let label = format!("{scenes} scenes in all");
    let (cases, failures, read_back) =
        monitor.watch_steps(&label, &estimate.steps.concat(), |watch| {
            measure_all(plan, gpu, watch)
        })?;
    Ok(Run {
        format: FORMAT,
        program: PROGRAM.to_owned(),
        command,
        adapter: gpu.map(|gpu| gpu.adapter.clone()),
        render: plan.render,
        common_alignment: plan.common_alignment().name().to_owned(),
        overall: overall(&cases),
        failures,
        cases,
        read_back,
    })
}

/// Measures scene after scene, and counts the cases that were read back.
fn measure_all(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    watch: Watch,
) -> Result<(Vec<Case>, Vec<Failure>, usize), Error> {
    let filters = plan.scaled_filters();
    let (mut cases, mut failures, mut read_back) = (Vec::new(), Vec::new(), 0);
    for (number, scene) in (0..).zip(SceneContext::all(plan, &filters, gpu)) {
        let steps = scene.steps();
        let advance = |done: u64| {
            // A scene that is interrupted returns the error itself.
            let _ = watch(Progress {
                done: number * steps + done.min(steps),
                total: plan.all_scenes().len() as u64 * steps,
            });
        };
        advance(0);
        let (measured, found) = scene.measure_cases(&advance)?;
        read_back += found;
        for case in measured {
            match case {
                Ok(case) => cases.push(case),
                Err(failure) => failures.push(failure),
            }
        }
    }
    Ok((cases, failures, read_back))
}
