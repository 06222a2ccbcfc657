//! Rough estimates of the time, disk space and memory of a run. Times are off by a factor of two or
//! three: scenes differ by a factor of six.

use std::convert::Infallible;

use crate::{LADDER, RenderFile, hash_program, look_up_alone};
use filters::Gpu;
use frame::Alignment;
use tracer::RenderSettings;

use super::frames::visit_frames;
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::scene::SceneContext;
use super::scenes::count_lanes;
use crate::render::run_scene::needed_rungs;

/// CPU time in seconds to prepare a scene for rays, and of a sample: means over the shipped scenes,
/// on two cores of a server with llvmpipe.
const SCENE: f64 = 0.2;
const SAMPLE: f64 = 0.9e-6;
/// Samples of a whole ladder, relative to its truth: only pixels near motion need it.
const WHOLE_LADDER: f64 = 0.8;
/// Time in seconds to run a filter and measure its picture: at any size, and per pixel; and per
/// pixel to write its part of the report.
const CASE: f64 = 0.035;
const CASE_PIXEL: f64 = 6e-6;
const REPORT_PIXEL: f64 = 0.45e-6;
/// Time of a case with intervals, relative to one without; with a ladder, counts of sub-frames have
/// intervals.
const INTERVALS: f64 = 2.0;
/// Bytes on disk per pixel of a picture: a frame, a replicate, or a case with its part of the
/// report.
const PICTURE_BYTES: u64 = 22;
/// Pictures with the disk space of a truth and its ladder, without replicates.
const PICTURES_OF_TRUTH: u64 = 5;

/// Work that a run has to do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunEstimate {
    /// Time in seconds, on the threads of this process.
    pub seconds: f64,
    /// Bytes of files that will be written.
    pub disk: u64,
    /// Peak memory in bytes.
    pub memory: u64,
    /// Number of cases.
    pub cases: usize,
    /// Number of cases that were measured before, with the same inputs.
    pub read_back: usize,
}

/// Estimates a run: cases and truths in the folder need no time. Does not read their pictures, and
/// measures nothing.
pub fn estimate_run(plan: &RunPlan, gpu: Option<&Gpu>) -> RunEstimate {
    let pixels = count_pixels(&plan.render);
    let mut estimate = RunEstimate::default();
    let mut memories = Vec::new();
    let program = hash_program();
    let mut visit = |scene: &SceneContext| {
        let planned = PlannedCase::all(plan, scene.scene);
        let has_record =
            |case: &&PlannedCase| !plan.no_cache && scene.read_case(case, look_up_alone).is_some();
        let read_back = planned.iter().filter(has_record).count();
        estimate.cases += planned.len();
        estimate.read_back += read_back;
        let cases = planned.len() - read_back;
        if cases == 0 {
            return Ok::<(), Infallible>(());
        }
        let missing = scene.find_missing();
        let frame = missing.contains(&RenderFile::Frame);
        let truths: Vec<Alignment> = missing.iter().filter_map(|file| file.alignment()).collect();
        let ladders = count_ladders(plan, &truths);
        let rendering = render_cpu_seconds(&plan.render, frame, truths.len(), ladders);
        estimate.seconds += rendering / threads() + cases as f64 * case_seconds(plan);
        let of_truth = PICTURES_OF_TRUTH + u64::from(plan.render.replicates);
        let pictures = u64::from(frame) + truths.len() as u64 * of_truth + cases as u64;
        estimate.disk += pixels as u64 * pictures * PICTURE_BYTES;
        let truths = plan.alignments().len();
        let measured = plan.measured(scene.scene, truths);
        memories.push((scene.scene).memory(&plan.render, measured));
        Ok(())
    };
    let scenes = plan.all_scenes();
    for scene in &scenes {
        let Ok(()) = visit_frames(plan, gpu, program.as_deref(), *scene, &mut visit);
    }
    // The largest scenes may be measured side by side.
    memories.sort_by(|a, b| b.cmp(a));
    estimate.memory = memories.iter().take(count_lanes(plan, scenes.len())).sum();
    estimate.seconds += estimate.cases as f64 * pixels * REPORT_PIXEL;
    estimate
}

/// Estimates the time to render a scene's frame and some truths, in seconds.
pub fn estimate_render_seconds(render: &RenderSettings, truths: usize) -> f64 {
    render_cpu_seconds(render, true, truths, 0.0) / threads()
}

/// Estimates the time to run a filter once and measure its picture, in seconds.
pub fn estimate_case_seconds(render: &RenderSettings) -> f64 {
    CASE + count_pixels(render) * CASE_PIXEL
}

/// Estimates the time of one case of a plan with its intervals, in seconds.
fn case_seconds(plan: &RunPlan) -> f64 {
    let has_intervals = plan.intervals || plan.ladders;
    let intervals = if has_intervals { INTERVALS } else { 1.0 };
    intervals * estimate_case_seconds(&plan.render)
}

/// Counts the ladders that measuring against some truths needs, in whole ladders.
fn count_ladders(plan: &RunPlan, truths: &[Alignment]) -> f64 {
    let rungs = truths.iter();
    let rungs = rungs.map(|alignment| needed_rungs(*alignment, plan.ladders).len());
    rungs.sum::<usize>() as f64 / LADDER.len() as f64
}

/// Estimates the CPU time to render some truths and ladders of a scene, and its frame if `frame` is
/// set.
fn render_cpu_seconds(render: &RenderSettings, frame: bool, truths: usize, ladders: f64) -> f64 {
    // A frame has as many samples as a truth.
    let pictures = f64::from(u32::from(frame)) + truths as f64 + WHOLE_LADDER * ladders;
    let samples = count_pixels(render) * pictures * f64::from(render.samples_per_pixel);
    (1 + truths) as f64 * SCENE + samples * SAMPLE
}

fn count_pixels(render: &RenderSettings) -> f64 {
    f64::from(render.width) * f64::from(render.height)
}

fn threads() -> f64 {
    rayon::current_num_threads() as f64
}
