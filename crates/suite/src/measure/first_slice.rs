//! Costs of rendering and measuring, from a first slice: a few samples of a small picture.

use std::ops::ControlFlow;
use std::time::Instant;

use frame::Alignment;
use tracer::{Progress, RenderSettings, Scene, TruthTracer, trace_frame};

use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::run_scene::RunScene;
use super::scene::SceneContext;
use crate::render::settings::SIDES;

/// Pixels of the small picture.
const PIXELS: f64 = 1500.0;
/// Upper limit on the samples per pixel of its frame and of its replicates.
const SAMPLES: u32 = 16;

/// Costs of rendering a scene, in seconds on the threads of this process.
#[derive(Clone, Copy, Debug)]
pub(super) struct RenderCosts {
    /// Preparing the scene for rays.
    pub scene: f64,
    /// A pixel of a truth's support and pilot.
    pub support: f64,
    /// A sample of a frame.
    pub frame: f64,
    /// A sample of a truth.
    pub truth: f64,
}

impl RenderCosts {
    /// Returns means over the shipped scenes, as two cores of a server take them; scenes differ by a factor of six.
    pub fn usual() -> Self {
        let threads = rayon::current_num_threads() as f64;
        Self {
            scene: 0.1,
            support: 20e-6 / threads,
            frame: 0.5e-6 / threads,
            truth: 0.9e-6 / threads,
        }
    }

    /// Renders the small picture; none where the scene cannot be rendered.
    pub fn measure(scene: &Scene, render: &RenderSettings) -> Option<Self> {
        let watch = |_: Progress| ControlFlow::Continue(());
        let render = small_settings(render);
        let (tracer, preparing) =
            measure_time(|| TruthTracer::new(scene, &render, &[Alignment::Trailing]).ok());
        let tracer = tracer?;
        let (first, with_support) = measure_time(|| tracer.trace(0, &watch).ok());
        // The faster of two, which fewer other programs have interrupted.
        let (second, one) = measure_time(|| tracer.trace(1, &watch).ok());
        let (_, other) = measure_time(|| tracer.trace(2, &watch).ok());
        let alone = one.min(other);
        let settings = render.with_replicates(1);
        let (frame, framing) = measure_time(|| trace_frame(scene, &settings, &watch).ok());
        first.and(second)?;
        frame?;
        let pixels = f64::from(render.width) * f64::from(render.height);
        let samples = pixels * f64::from(settings.samples_per_pixel);
        Some(Self {
            scene: preparing,
            support: (with_support - alone).max(0.0) / pixels,
            frame: (framing - preparing).max(0.2 * alone) / samples,
            truth: alone / samples,
        })
    }
}

/// Measures the references and the first filter on the small picture of a scene; returns the seconds and the number of cases. None
/// where they cannot be measured, no adapter is open, or every filter is a program.
pub(super) fn measure_first_cases(scene: &SceneContext) -> Option<(f64, usize)> {
    // Kernels need the adapter.
    scene.gpu?;
    let RunScene::Traced(_) = scene.scene else {
        return None;
    };
    let mut filters = scene.plan.filters.iter();
    let first = filters.find(|choice| choice.filter.command.is_none())?;
    let folder = tempfile::tempdir().ok()?;
    let plan = RunPlan {
        filters: vec![first.clone()],
        jitter_frames: scene.plan.jitter_frames,
        render: small_settings(&scene.plan.render),
        out: folder.path().to_owned(),
        ladders: scene.plan.ladders,
        monitor: scene.plan.monitor.without_progress(),
        ..RunPlan::default()
    };
    let filters = plan.scaled_filters();
    let scene = SceneContext {
        plan: &plan,
        filters: &filters,
        keys: None,
        ..*scene
    };
    let planned = PlannedCase::all(&plan, &filters, scene.scene);
    let due: Vec<&PlannedCase> = planned.iter().collect();
    let frame = scene.render(&|_| {}).ok()?;
    let watch = |_: Progress| ControlFlow::Continue(());
    let (cases, seconds) = measure_time(|| {
        scene
            .measure(&due, &frame, &|_| {}, &watch)
            .ok()
            .map(|cases| cases.len())
    });
    Some((seconds, cases?))
}

/// Counts the pixels of the small picture for a picture of another size.
pub(super) fn count_small_pixels(render: &RenderSettings) -> f64 {
    let small = small_settings(render);
    f64::from(small.width) * f64::from(small.height)
}

/// Takes a smaller picture and fewer samples.
fn small_settings(render: &RenderSettings) -> RenderSettings {
    let pixels = f64::from(render.width) * f64::from(render.height);
    let scale = (PIXELS / pixels).sqrt().min(1.0);
    let side = |side: u32| ((f64::from(side) * scale) as u32).max(*SIDES.start());
    let samples = (render.samples_per_replicate()).min(SAMPLES);
    RenderSettings {
        width: side(render.width),
        height: side(render.height),
        guard_band: 0,
        samples_per_pixel: 2 * samples,
        replicates: 2,
        ..*render
    }
}

/// Does some work and returns its time in seconds.
fn measure_time<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let began = Instant::now();
    let done = work();
    (done, began.elapsed().as_secs_f64())
}
