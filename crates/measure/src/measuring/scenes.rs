//! Runs: every scene of a plan, measured in turn.

use std::time::Instant;

use filters::Gpu;
use scene::SceneId;
use tracer::{Progress, Watch};

use super::frames::{count_frames, visit_frames};
use super::measured_filters::copy_filters;
use super::plan::RunPlan;
use super::scene::SceneCases;
use super::sequence::measure_sequences;
use crate::Error;
use crate::run::Run;
use crate::run::case::Case;
use crate::stats::overall::overall;

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself.
/// Reads back an earlier run's measurements of the same inputs there. `gpu` is what
/// [`open_gpu`](crate::open_gpu) opened for the plan's filters.
pub fn measure_scenes(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    command: Vec<String>,
) -> Result<Run, Error> {
    copy_filters(plan)?;
    // With a single scene, its steps show all of the progress.
    let count = count_frames(plan);
    let monitor = match count {
        1 => plan.monitor.without_progress(),
        _ => plan.monitor,
    };
    let label = if plan.frames.is_one() {
        format!("{count} scenes in all")
    } else {
        format!("{count} frames in all")
    };
    let mut run = plan.facts(gpu.map(|gpu| &gpu.adapter));
    run.command = command;
    monitor.watch(&label, |watch| measure_all(plan, gpu, &mut run, watch))?;
    run.overall = overall(&run.cases);
    Ok(run)
}

/// Measures every scene in turn, and each frame of it, into a run.
fn measure_all(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    run: &mut Run,
    watch: Watch,
) -> Result<(), Error> {
    let mut frames: Vec<Vec<Case>> = Vec::new();
    let mut number = 0;
    visit_frames(plan, gpu, |scene| {
        let steps = scene.steps();
        let advance = |done: u64| {
            // An interrupted scene returns the error itself.
            let _ = watch(Progress {
                done: number * steps + done.min(steps),
                total: count_frames(plan) as u64 * steps,
            });
        };
        advance(0);
        let began = Instant::now();
        let SceneCases {
            cases,
            failures,
            read_back,
        } = scene.measure_cases(&advance)?;
        number += 1;
        run.read_back += read_back;
        run.failures.extend(failures);
        let id = scene.scene.id();
        let frame = id.frame;
        let first = SceneId {
            frame: 0,
            ..id.clone()
        };
        *run.seconds.entry(first).or_default() += began.elapsed().as_secs_f64();
        if frame == 0 {
            run.cases.extend_from_slice(&cases);
            frames.clear();
        }
        frames.push(cases);
        if frame > 0 && frame + 1 == plan.frames.count {
            run.sequences.extend(measure_sequences(plan, &frames)?);
        }
        Ok(())
    })
}
