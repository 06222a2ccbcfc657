//! Runs: every scene of a plan, several side by side.

use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::thread;
use std::time::Instant;

use filters::Gpu;
use scene::SceneId;
use tracer::{Progress, Watch};

use super::frames::{count_frames, visit_frames};
use super::measured_filters::copy_filters;
use super::plan::RunPlan;
use super::sequence::measure_sequences;
use crate::filter_choice::FilterChoice;
use crate::render::run_scene::RunScene;
use crate::run::Run;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::run::sequence::Sequence;
use crate::stats::overall::overall;
use crate::{Error, hash_program};

/// Scenes that are measured side by side at most. Much of a scene's work has a single thread.
const MAX_LANES: usize = 4;
/// Pixels that the frames side by side have at most: each takes its own memory.
const MAX_LANE_PIXELS: u64 = 1 << 20;
/// Bytes of a lane's stack, as a main thread has: shaders are nested.
const STACK: usize = 8 << 20;

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
    for scene in monitor.watch(&label, |watch| measure_all(plan, gpu, watch))? {
        scene.add_to(&mut run);
    }
    run.overall = overall(&run.cases);
    Ok(run)
}

/// What was measured of a scene.
struct MeasuredScene {
    id: SceneId,
    /// Cases of its first frame.
    cases: Vec<Case>,
    /// Sequences of its frames, if it has several.
    sequences: Vec<Sequence>,
    failures: Vec<Failure>,
    read_back: usize,
    seconds: f64,
}

impl MeasuredScene {
    fn add_to(self, run: &mut Run) {
        run.cases.extend(self.cases);
        run.sequences.extend(self.sequences);
        run.failures.extend(self.failures);
        run.read_back += self.read_back;
        *run.seconds.entry(self.id).or_default() += self.seconds;
    }
}

/// Measures every scene, some side by side; returns them in the plan's order. After an error, no
/// further scene begins.
fn measure_all(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    watch: Watch,
) -> Result<Vec<MeasuredScene>, Error> {
    let scenes = plan.all_scenes();
    let program = hash_program();
    let meter = SceneMeter::new(plan, scenes.len(), watch);
    let next = AtomicUsize::new(0);
    // The first error is the cause; others may follow from it.
    let failed = OnceLock::new();
    let measured = Mutex::new(Vec::new());
    let work = || {
        while failed.get().is_none() {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(scene) = scenes.get(index) else {
                break;
            };
            let advance = |done| meter.advance(index, done);
            match measure_scene(plan, gpu, program.as_deref(), *scene, &advance) {
                Ok(scene) => {
                    (plan.finished)(&scene.cases);
                    let mut measured = measured.lock().expect("no lane panics");
                    measured.push((index, scene));
                }
                Err(error) => _ = failed.set(error),
            }
        }
    };
    thread::scope(|lanes| {
        for _ in 0..count_lanes(plan, scenes.len()) {
            let lane = thread::Builder::new().stack_size(STACK);
            lane.spawn_scoped(lanes, work).expect("a thread can start");
        }
    });
    if let Some(error) = failed.into_inner() {
        return Err(error);
    }
    let mut measured = measured.into_inner().expect("no lane panics");
    measured.sort_by_key(|(index, _)| *index);
    Ok(measured.into_iter().map(|(_, scene)| scene).collect())
}

/// Counts the lanes for a plan: one for sequences, for large pictures, and for programs of users,
/// which may not bear a second one of themselves.
pub(super) fn count_lanes(plan: &RunPlan, scenes: usize) -> usize {
    let runs_program = |choice: &FilterChoice| choice.filter.command.is_some();
    if !plan.frames.is_one() || plan.filters.iter().any(runs_program) {
        return 1;
    }
    let pixels = u64::from(plan.render.width) * u64::from(plan.render.height);
    let fitting = (MAX_LANE_PIXELS / pixels.max(1)) as usize;
    let threads = rayon::current_num_threads();
    threads.min(MAX_LANES).min(fitting).min(scenes).max(1)
}

/// Measures a scene, and each later frame of it. `advance` gets the number of finished steps.
fn measure_scene(
    plan: &RunPlan,
    gpu: Option<&Gpu>,
    program: Option<&str>,
    scene: RunScene,
    advance: &dyn Fn(u64),
) -> Result<MeasuredScene, Error> {
    let began = Instant::now();
    let mut measured = MeasuredScene {
        id: scene.id().clone(),
        cases: Vec::new(),
        sequences: Vec::new(),
        failures: Vec::new(),
        read_back: 0,
        seconds: 0.0,
    };
    let mut frames: Vec<Vec<Case>> = Vec::new();
    visit_frames(plan, gpu, program, scene, |frame| {
        let before = frames.len() as u64 * plan.steps();
        advance(before);
        let made = frame.measure_cases(&|done| advance(before + done.min(plan.steps())))?;
        measured.failures.extend(made.failures);
        measured.read_back += made.read_back;
        frames.push(made.cases);
        Ok::<(), Error>(())
    })?;
    if frames.len() > 1 {
        measured.sequences = measure_sequences(plan, &frames)?;
    }
    measured.cases = frames.swap_remove(0);
    measured.seconds = began.elapsed().as_secs_f64();
    Ok(measured)
}

/// Progress of scenes side by side.
struct SceneMeter<'a> {
    watch: Watch<'a>,
    /// Finished steps of each scene.
    done: Vec<AtomicU64>,
    /// Steps of all scenes.
    total: u64,
}

impl<'a> SceneMeter<'a> {
    fn new(plan: &RunPlan, scenes: usize, watch: Watch<'a>) -> Self {
        Self {
            watch,
            done: (0..scenes).map(|_| AtomicU64::new(0)).collect(),
            total: count_frames(plan) as u64 * plan.steps(),
        }
    }

    /// Notes how many steps of a scene are finished.
    fn advance(&self, scene: usize, done: u64) {
        self.done[scene].store(done, Ordering::Relaxed);
        let done = self.done.iter().map(|done| done.load(Ordering::Relaxed));
        // An interrupted scene returns the error itself.
        let _ = (self.watch)(Progress {
            done: done.sum(),
            total: self.total,
        });
    }
}
