//! Runs: scene after scene, measured by one plan.

use filters::Gpu;
use tracer::{Progress, Watch};

use super::plan::RunPlan;
use super::scene::SceneContext;
use crate::cache::record::hash_program;
use crate::cache::scene_keys::SceneKeys;
use crate::filter::choice::FilterChoice;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::{FORMAT, Run};
use crate::stats::overall::overall;
use crate::{Error, PROGRAM};

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself. Reads back what an earlier run
/// measured of the same inputs and left there. `gpu` is what [`open_gpu`](crate::open_gpu) opened for the plan's filters.
pub fn measure_scenes(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    command: Vec<String>,
) -> Result<Run, Error> {
    // The steps of a single scene show all of the progress.
    let monitor = match plan.scenes.len() {
        1 => plan.monitor.without_progress(),
        _ => plan.monitor,
    };
    let label = format!("{} scenes in all", plan.scenes.len());
    let (cases, failures) = monitor.watch(&label, |watch| measure_all(plan, gpu, watch))?;
    Ok(Run {
        format: FORMAT,
        program: PROGRAM.to_owned(),
        command,
        adapter: gpu.map(|gpu| gpu.adapter.clone()),
        width: plan.render.width,
        height: plan.render.height,
        samples_per_pixel: plan.render.samples_per_pixel,
        replicates: plan.render.replicates,
        seed: plan.render.seed,
        velocity: plan.render.velocity.name().to_owned(),
        color: plan.render.color.name().to_owned(),
        sky_velocity: plan.render.sky_velocity,
        guard_band: plan.render.guard_band,
        common_alignment: plan.common_alignment().name().to_owned(),
        overall: overall(&cases),
        failures,
        cases,
    })
}

fn measure_all(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    watch: Watch,
) -> Result<(Vec<Case>, Vec<Failure>), Error> {
    let program = hash_program();
    let filters: Vec<FilterChoice> = (plan.filters.iter())
        .map(|choice| choice.scaled_to(plan.render.width))
        .collect();
    let (mut cases, mut failures) = (Vec::new(), Vec::new());
    for (done, scene) in plan.scenes.iter().enumerate() {
        // A scene that is interrupted returns the error itself.
        let _ = watch(Progress {
            done: done as u64,
            total: plan.scenes.len() as u64,
        });
        let keys = (program.as_ref())
            .map(|program| SceneKeys::new(program, scene, &plan.render, plan.alignments()));
        let context = SceneContext {
            plan,
            filters: &filters,
            gpu,
            scene,
            keys,
        };
        for case in context.measure_cases()? {
            match case {
                Ok(case) => cases.push(case),
                Err(failure) => failures.push(failure),
            }
        }
    }
    Ok((cases, failures))
}
