//! Estimates of the time, disk and memory that a run takes, before it begins.

use filters::Gpu;

use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::scene::SceneContext;
use super::scenes::{scale_filters, scene_contexts};
use crate::RenderSettings;
use crate::render::memory::measuring_memory;

/// CPU time per sample of a pixel, in seconds. This constant and those below were measured on two cores of a server, with
/// llvmpipe, on the scenes railing and fan at 160x90; other scenes and machines differ by a factor of two or three.
const SECONDS_PER_SAMPLE: f64 = 0.9e-6;
/// Samples of a truth and its ladder, relative to those of the truth.
const LADDER: f64 = 1.4;
/// CPU time per pixel to run a filter and measure its picture, in seconds.
const SECONDS_PER_CASE: f64 = 18e-6;
/// Time of a case with intervals, relative to one without.
const INTERVALS: f64 = 2.0;
/// Bytes on disk per pixel: of a frame, of a truth with its ladder, of each replicate, and of a case.
const FRAME_BYTES: u64 = 100;
const TRUTH_BYTES: u64 = 170;
const REPLICATE_BYTES: u64 = 35;
const CASE_BYTES: u64 = 28;

/// Work that a run has to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
}

/// Estimates a run: cases and truths that lie in the folder take no time. Does not read their pictures.
pub fn estimate_run(plan: &RunPlan, gpu: Option<&Gpu>) -> RunEstimate {
    let filters = scale_filters(plan);
    let planned = PlannedCase::all(plan, &filters);
    let mut estimate = RunEstimate::default();
    let mut cpu = 0.0;
    for scene in scene_contexts(plan, &filters, gpu) {
        let kept = match plan.no_cache {
            true => 0,
            false => (planned.iter())
                .filter(|case| scene.has_record(case))
                .count(),
        };
        estimate.cases += planned.len();
        estimate.kept += kept;
        let due = planned.len() - kept;
        if due > 0 {
            let (seconds, bytes) = estimate_scene(&scene, due);
            cpu += seconds;
            estimate.disk += bytes;
            let memory = measuring_memory(scene.scene, &plan.render);
            estimate.memory = estimate.memory.max(memory);
        }
    }
    estimate.seconds = cpu / rayon::current_num_threads() as f64;
    estimate
}

/// Estimates the seconds that it takes to render the frame of a scene and some of its truths, where nothing is kept.
pub fn estimate_render_seconds(render: &RenderSettings, truths: usize) -> f64 {
    let samples = count_pixels(render) as f64 * f64::from(render.samples_per_pixel);
    (1 + truths) as f64 * samples * SECONDS_PER_SAMPLE / rayon::current_num_threads() as f64
}

/// Estimates the seconds that it takes to run a filter once and to measure its picture.
pub fn estimate_case_seconds(render: &RenderSettings) -> f64 {
    count_pixels(render) as f64 * SECONDS_PER_CASE / rayon::current_num_threads() as f64
}

fn count_pixels(render: &RenderSettings) -> u64 {
    u64::from(render.width) * u64::from(render.height)
}

/// Estimates the CPU time and the disk of one scene with some cases to measure.
fn estimate_scene(scene: &SceneContext, due: usize) -> (f64, u64) {
    let plan = scene.plan;
    let render = &plan.render;
    let pixels = count_pixels(render);
    let samples = pixels as f64 * f64::from(render.samples_per_pixel);
    let (frame, truths) = match plan.no_cache {
        true => (true, plan.alignments().len()),
        false => scene.count_missing(),
    };
    let case = match plan.intervals {
        true => SECONDS_PER_CASE * INTERVALS,
        false => SECONDS_PER_CASE,
    };
    let traced = f64::from(u8::from(frame)) + LADDER * truths as f64;
    let seconds = traced * samples * SECONDS_PER_SAMPLE + due as f64 * pixels as f64 * case;
    let truth = TRUTH_BYTES + u64::from(render.replicates) * REPLICATE_BYTES;
    let bytes = u64::from(frame) * FRAME_BYTES + truths as u64 * truth + due as u64 * CASE_BYTES;
    (seconds, pixels.saturating_mul(bytes))
}
