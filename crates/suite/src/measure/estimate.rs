//! Estimates of the time, disk and memory that a run takes, before it begins.

use std::convert::Infallible;

use filters::Gpu;
use frame::Alignment;
use store::LADDER;
use tracer::RenderSettings;

use super::frames::visit_frames;
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::run_scene::RunScene;
use crate::render::ladders::needed_rungs;
use crate::render::settings::frame_settings;

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
}

/// Costs of rendering, in seconds on the threads of this process: means over the shipped scenes, as two cores of a server take them.
/// Scenes differ by a factor of six.
struct RenderCosts {
    /// Preparing the scene for rays.
    scene: f64,
    /// A pixel of a truth's support and pilot.
    support: f64,
    /// A sample of a frame.
    frame: f64,
    /// A sample of a truth.
    truth: f64,
}

impl RenderCosts {
    fn usual() -> Self {
        let threads = rayon::current_num_threads() as f64;
        Self {
            scene: 0.1,
            support: 20e-6 / threads,
            frame: 0.5e-6 / threads,
            truth: 0.9e-6 / threads,
        }
    }
}

/// Estimates a run: cases and truths that lie in the folder take no time. Does not read their pictures, measures nothing, and is off by
/// a factor of two or three.
pub fn estimate_run(plan: &RunPlan, gpu: Option<&Gpu>) -> RunEstimate {
    let filters = plan.scaled_filters();
    let mut estimate = RunEstimate::default();
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
        if due == 0 {
            return Ok::<(), Infallible>(());
        }
        let alignments = plan.alignments();
        let (frame, truths) = match (scene.scene, plan.no_cache) {
            // What an engine drew is copied in no time.
            (RunScene::Drawn(_), _) => (false, vec![false; alignments.len()]),
            (_, true) => (true, vec![true; alignments.len()]),
            (_, false) => scene.find_missing(),
        };
        let missing: Vec<_> = (alignments.iter().zip(&truths))
            .filter_map(|(alignment, missing)| missing.then_some(*alignment))
            .collect();
        estimate.seconds += scene_seconds(plan, frame, &missing, due);
        estimate.disk += count_bytes(&plan.render, (frame, missing.len()), due);
        let memory = (scene.scene).memory(&plan.render, truths.len(), plan.inputs.len());
        estimate.memory = estimate.memory.max(memory);
        Ok(())
    });
    let Ok(()) = visited;
    let report = estimate.cases as f64 * count_pixels(&plan.render);
    estimate.seconds += report * SECONDS_PER_REPORT_PIXEL;
    estimate
}

/// Estimates the seconds that it takes to render a scene's frame and missing truths, and to measure the cases that are due.
fn scene_seconds(plan: &RunPlan, frame: bool, missing: &[Alignment], due: usize) -> f64 {
    let render = &plan.render;
    let frame = if frame { frame_seconds(render) } else { 0.0 };
    let ladders = missing.iter().map(|alignment| {
        let rungs = needed_rungs(*alignment, plan.ladders).len();
        ladder_seconds(render, rungs)
    });
    let intervals = if plan.intervals { INTERVALS } else { 1.0 };
    frame
        + shared_truths(missing.len()) * truth_seconds(render)
        + ladders.sum::<f64>()
        + due as f64 * intervals * estimate_case_seconds(render)
}

/// Estimates the seconds that it takes to render a scene's frame and some truths, where nothing is kept.
pub fn estimate_render_seconds(render: &RenderSettings, truths: usize) -> f64 {
    frame_seconds(render) + shared_truths(truths) * truth_seconds(render)
}

/// Estimates the seconds that it takes to run a filter once and to measure its picture.
pub fn estimate_case_seconds(render: &RenderSettings) -> f64 {
    SECONDS_PER_CASE + count_pixels(render) * SECONDS_PER_CASE_PIXEL
}

pub(super) fn count_pixels(render: &RenderSettings) -> f64 {
    f64::from(render.width) * f64::from(render.height)
}

fn count_samples(render: &RenderSettings) -> f64 {
    count_pixels(render) * f64::from(render.samples_per_pixel)
}

pub(super) fn frame_seconds(render: &RenderSettings) -> f64 {
    let costs = RenderCosts::usual();
    let samples = f64::from(frame_settings(render).samples_per_pixel);
    costs.scene + count_pixels(render) * samples * costs.frame
}

pub(super) fn truth_seconds(render: &RenderSettings) -> f64 {
    let costs = RenderCosts::usual();
    costs.scene + count_pixels(render) * costs.support + count_samples(render) * costs.truth
}

/// Estimates the seconds that it takes to render some rungs of a ladder.
pub(super) fn ladder_seconds(render: &RenderSettings, rungs: usize) -> f64 {
    let costs = RenderCosts::usual();
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

/// Counts the bytes on disk of a scene's frame, some truths and some cases.
fn count_bytes(render: &RenderSettings, (frame, truths): (bool, usize), due: usize) -> u64 {
    let truth = TRUTH_BYTES + u64::from(render.replicates) * REPLICATE_BYTES;
    let bytes = u64::from(frame) * FRAME_BYTES + truths as u64 * truth + due as u64 * CASE_BYTES;
    (u64::from(render.width) * u64::from(render.height)).saturating_mul(bytes)
}
