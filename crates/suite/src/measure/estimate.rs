//! Estimates of the time, disk and memory that a run takes, before it begins.

use std::convert::Infallible;

use filters::Gpu;
use store::LADDER;
use tracer::{Progress, RenderSettings, Scene};

use super::first_slice::{RenderCosts, count_small_pixels, measure_first_cases};
use super::frames::visit_frames;
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::run_scene::RunScene;
use super::scene::SceneContext;
use crate::render::ladders::needed_rungs;
use crate::render::settings::frame_settings;

/// Time in seconds from which a first slice is measured; shorter work is over before that pays.
const WORTH_A_SLICE: f64 = 3.0;
/// Time of a ladder, relative to its truth's samples: the mean of five scenes. It is about the pixels near motion alone.
const WHOLE_LADDER: f64 = 0.4;
/// Time to run a filter and measure its picture, whatever its size, in seconds. This number and the next ones were measured with
/// llvmpipe on two cores of a server.
const SECONDS_PER_CASE: f64 = 0.035;
/// Time per pixel to run a filter and measure its picture, in seconds.
const SECONDS_PER_CASE_PIXEL: f64 = 6e-6;
/// Time per pixel and case to write the report, in seconds.
pub(super) const SECONDS_PER_REPORT_PIXEL: f64 = 0.45e-6;
/// Time of a case with intervals, relative to one without.
pub(super) const INTERVALS: f64 = 2.0;
/// Bytes on disk per pixel: of a frame, of a truth with its ladder, of each replicate, and of a case with its part of the report.
const FRAME_BYTES: u64 = 25;
const TRUTH_BYTES: u64 = 170;
const REPLICATE_BYTES: u64 = 35;
const CASE_BYTES: u64 = 36;

/// Work that a run has to do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunEstimate {
    /// Time in seconds, on the threads of this process.
    pub seconds: f64,
    /// Bytes of files that will be written.
    pub disk: u64,
    /// Bytes of memory at the most.
    pub memory: u64,
    /// Number of cases.
    pub cases: usize,
    /// Number of cases that were measured before, with the same inputs.
    pub kept: usize,
    /// Seconds of every step of each scene: its frame; per truth its replicates and its ladder; its cases.
    pub steps: Vec<Vec<f64>>,
}

/// Costs of a scene's pictures and cases, in seconds on the threads of this process.
#[derive(Clone)]
struct SceneCosts {
    render: RenderCosts,
    case: f64,
}

/// Estimates a run: cases and truths that lie in the folder take no time. Does not read their pictures. A run that takes long is
/// estimated from a measured first slice: a few samples of a small picture of every scene, and the first cases of one.
pub fn estimate_run(plan: &RunPlan, gpu: Option<&Gpu>) -> RunEstimate {
    let rough = estimate_run_roughly(plan, gpu);
    if rough.seconds < WORTH_A_SLICE {
        return rough;
    }
    let mut speed = None;
    let mut done = 0;
    let label = "first slices, to estimate the time";
    plan.monitor.watch(label, |watch| {
        estimate_with(plan, gpu, |scene, renders| {
            let total = plan.all_scenes().len() as u64;
            // What is interrupted here ends in the first scene.
            let _ = watch(Progress { done, total });
            done += 1;
            let slice = match (renders, scene.scene) {
                (true, RunScene::Traced(scene)) => RenderCosts::measure(scene, &plan.render),
                _ => None,
            };
            let speed = *speed.get_or_insert_with(|| measure_case_speed(scene).unwrap_or(1.0));
            SceneCosts {
                render: slice.unwrap_or_else(RenderCosts::usual),
                case: speed * usual_case_seconds(count_pixels(&plan.render)),
            }
        })
    })
}

/// Estimates a run without measuring anything; off by a factor of two or three.
pub fn estimate_run_roughly(plan: &RunPlan, gpu: Option<&Gpu>) -> RunEstimate {
    estimate_with(plan, gpu, |_, _| SceneCosts {
        render: RenderCosts::usual(),
        case: usual_case_seconds(count_pixels(&plan.render)),
    })
}

/// Estimates a run with the costs of each scene that has work to do, and has pictures to render or none.
fn estimate_with(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    mut costs: impl FnMut(&SceneContext, bool) -> SceneCosts,
) -> RunEstimate {
    let filters = plan.scaled_filters();
    let mut estimate = RunEstimate::default();
    let pixels = count_pixels(&plan.render);
    let mut last: Option<SceneCosts> = None;
    let visited = visit_frames(plan, &filters, gpu, |scene| {
        let planned = PlannedCase::all(plan, &filters, scene.scene);
        let kept = match plan.no_cache {
            true => 0,
            false => (planned.iter())
                .filter(|case| scene.has_record(case))
                .count(),
        };
        estimate.cases += planned.len();
        estimate.kept += kept;
        let due = planned.len() - kept;
        let is_drawn = matches!(scene.scene, RunScene::Drawn(_));
        let (frame, truths) = match (due, plan.no_cache) {
            // What an engine drew is copied in no time.
            _ if is_drawn => (false, vec![false; plan.alignments().len()]),
            (0, _) => (false, vec![false; plan.alignments().len()]),
            (_, true) => (true, vec![true; plan.alignments().len()]),
            (_, false) => scene.find_missing(),
        };
        let renders = frame || truths.contains(&true);
        let costs = match (due, &last) {
            (0, _) => None,
            // Frames of one scene cost about the same.
            (_, Some(last)) if scene.scene.frame_index() > 0 => Some(last.clone()),
            _ => Some(costs(scene, renders)),
        };
        last.clone_from(&costs);
        let rungs: Vec<usize> = (plan.alignments().into_iter())
            .map(|alignment| needed_rungs(alignment, plan.ladders).len())
            .collect();
        let missing = (frame, &truths[..], &rungs[..]);
        estimate
            .steps
            .push(step_seconds(plan, costs.as_ref(), missing, due));
        if due > 0 {
            let truths = truths.iter().filter(|missing| **missing).count();
            estimate.disk += count_bytes(&plan.render, (frame, truths), due);
            let truths = plan.alignments().len();
            let memory = (scene.scene).memory(&plan.render, truths, plan.inputs.len());
            estimate.memory = estimate.memory.max(memory);
        }
        Ok::<(), Infallible>(())
    });
    let Ok(()) = visited;
    let report = estimate.cases as f64 * pixels;
    let steps: f64 = estimate.steps.iter().flatten().sum();
    estimate.seconds = steps + report * SECONDS_PER_REPORT_PIXEL;
    estimate
}

/// Estimates the seconds that it takes to render frames of scenes and some truths of each, where nothing is kept; measures a first
/// slice where that is long.
pub fn estimate_render_seconds(renders: &[(&Scene, RenderSettings)], truths: usize) -> f64 {
    let estimate = |find_costs: &dyn Fn(&Scene, &RenderSettings) -> RenderCosts| -> f64 {
        let seconds = renders.iter().map(|(scene, render)| {
            let costs = find_costs(scene, render);
            let each = truth_seconds(render, &costs);
            frame_seconds(render, &costs) + shared_truths(truths) * each
        });
        seconds.sum()
    };
    let rough = estimate(&|_, _| RenderCosts::usual());
    match rough < WORTH_A_SLICE {
        true => rough,
        false => estimate(&|scene, render| {
            RenderCosts::measure(scene, render).unwrap_or_else(RenderCosts::usual)
        }),
    }
}

/// Estimates the seconds that it takes to run a filter once and to measure its picture.
pub fn estimate_case_seconds(render: &RenderSettings) -> f64 {
    usual_case_seconds(count_pixels(render))
}

pub(super) fn usual_case_seconds(pixels: f64) -> f64 {
    SECONDS_PER_CASE + pixels * SECONDS_PER_CASE_PIXEL
}

/// Measures the first cases of a scene, relative to the usual time.
fn measure_case_speed(scene: &SceneContext) -> Option<f64> {
    let (seconds, cases) = measure_first_cases(scene)?;
    let usual = usual_case_seconds(count_small_pixels(&scene.plan.render));
    Some(seconds / (cases as f64 * usual))
}

pub(super) fn count_pixels(render: &RenderSettings) -> f64 {
    f64::from(render.width) * f64::from(render.height)
}

pub(super) fn count_samples(render: &RenderSettings) -> f64 {
    count_pixels(render) * f64::from(render.samples_per_pixel)
}

pub(super) fn frame_seconds(render: &RenderSettings, costs: &RenderCosts) -> f64 {
    costs.scene
        + count_pixels(render) * f64::from(frame_settings(render).samples_per_pixel) * costs.frame
}

pub(super) fn truth_seconds(render: &RenderSettings, costs: &RenderCosts) -> f64 {
    costs.scene + count_pixels(render) * costs.support + count_samples(render) * costs.truth
}

/// Estimates the seconds that it takes to render some rungs of a ladder.
pub(super) fn ladder_seconds(render: &RenderSettings, costs: &RenderCosts, rungs: usize) -> f64 {
    let part = WHOLE_LADDER * rungs as f64 / LADDER.len() as f64;
    match rungs {
        0 => 0.0,
        _ => costs.scene + part * count_samples(render) * costs.truth,
    }
}

/// Counts truths by their cost: two that overlap share the samples of half their time.
pub(super) fn shared_truths(truths: usize) -> f64 {
    match truths {
        0 | 1 => truths as f64,
        _ => truths as f64 - 0.5,
    }
}

/// Estimates every step of a scene, in the order of [`SceneContext::measure_cases`]; no time for those that are not due. `rungs` are
/// the numbers of rungs that the ladders of the truths need.
fn step_seconds(
    plan: &RunPlan,
    costs: Option<&SceneCosts>,
    (frame, truths, rungs): (bool, &[bool], &[usize]),
    due: usize,
) -> Vec<f64> {
    let render = &plan.render;
    let of_costs = |is_due: bool, seconds: &dyn Fn(&RenderSettings, &RenderCosts) -> f64| {
        let costs = costs.filter(|_| is_due);
        costs.map_or(0.0, |costs| seconds(render, &costs.render))
    };
    let mut steps = vec![of_costs(frame, &frame_seconds)];
    let missing = truths.iter().filter(|missing| **missing).count();
    let share = shared_truths(missing) / missing.max(1) as f64;
    for (missing, rungs) in truths.iter().zip(rungs) {
        let replicate = share * of_costs(*missing, &truth_seconds) / f64::from(render.replicates);
        steps.extend((0..render.replicates).map(|_| replicate));
        let ladder = |render: &_, costs: &_| ladder_seconds(render, costs, *rungs);
        steps.push(of_costs(*missing, &ladder));
    }
    let intervals = match plan.intervals {
        true => INTERVALS,
        false => 1.0,
    };
    steps.push(costs.map_or(0.0, |costs| due as f64 * intervals * costs.case));
    steps
}

/// Counts the bytes on disk of a scene's frame, some truths and some cases.
fn count_bytes(render: &RenderSettings, (frame, truths): (bool, usize), due: usize) -> u64 {
    let truth = TRUTH_BYTES + u64::from(render.replicates) * REPLICATE_BYTES;
    let bytes = u64::from(frame) * FRAME_BYTES + truths as u64 * truth + due as u64 * CASE_BYTES;
    (u64::from(render.width) * u64::from(render.height)).saturating_mul(bytes)
}
