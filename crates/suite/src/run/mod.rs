//! The main job: render every scene, run every filter on it, measure how far each picture is from the truth.

pub mod dilated;
pub mod earlier;
pub mod estimate;
pub mod failure;
pub mod file;
pub mod filter_choice;
pub mod finished;
pub mod input_format;
pub mod inputs;
pub mod intervals;
pub mod kept;
pub mod pictures;
pub mod probe;
pub mod runner;
pub mod scene_run;
pub mod score;
pub mod subject;
pub mod workbench;

use std::path::{Path, PathBuf};

use filters::{AdapterDescription, Gpu};
use frame::Alignment;
use metrics::Viewing;
use serde::{Deserialize, Serialize};
use tracer::{Progress, Scene, Watch};

use self::failure::Failure;
use self::file::parse;
use self::filter_choice::FilterChoice;
use self::inputs::SceneInputs;
use self::kept::hash_of_program;
use self::scene_run::SceneRun;
use crate::case::Case;
use crate::json::file::read_text;
use crate::stats::overall::{Overall, overall};
use crate::{Error, InputFormat, Monitor, PROGRAM, RenderSettings};

/// Version of the layout of `run.json`; it rises when a reader of the old one would misread the new one.
pub const FORMAT: u32 = 5;

/// A finished run: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Run {
    /// [`FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// The words of the command line.
    pub command: Vec<String>,
    /// What the kernels ran on; none where every filter is a command.
    pub adapter: Option<AdapterDescription>,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples per pixel of each truth, over all replicates.
    pub samples_per_pixel: u32,
    /// Independent renders behind each truth.
    pub replicates: u32,
    /// Seed of all randomness.
    pub seed: u64,
    /// What the velocity buffers held: `instantaneous`, `previous_frame` or `camera_only`.
    pub velocity: String,
    /// How the frames' colour was sampled: `antialiased` or `point`.
    pub color: String,
    /// Whether the background had a velocity.
    pub sky_velocity: bool,
    /// Pixels by which frames reached beyond the picture on every side.
    pub guard_band: u32,
    /// The shutter alignment that every case is compared with beside its own, so that filters of several alignments have one
    /// score in common: centred where a filter declares that, or else trailing, or else leading.
    pub common_alignment: String,
    /// Per scene: the bars, then one per filter preset and form of the input, in the order they ran.
    pub cases: Vec<Case>,
    /// Cases that failed, with their reasons; they have no scores.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<Failure>,
    /// Means over the scenes.
    #[serde(default)]
    pub overall: Vec<Overall>,
    /// Number of cases that were measured before and read back; not in run.json.
    #[serde(skip)]
    pub read_back: usize,
}

impl Run {
    /// Reads a `run.json` of this program.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let refuse = |reason: String| {
            Error::Usage(format!(
                "{}: {reason}; `shuttertruth run` or `check` writes one",
                path.display()
            ))
        };
        let text = read_text(path)?;
        parse(&text).map_err(refuse)
    }
}

/// What a run is to do.
pub struct Plan {
    /// Loaded scenes.
    pub scenes: Vec<Scene>,
    /// Loaded filters.
    pub filters: Vec<FilterChoice>,
    /// The forms in which every filter gets the frame.
    pub inputs: Vec<InputFormat>,
    /// Frames of noise that a noisy filter is tried with; fewer than 2 leave its noise alone.
    pub jitter_frames: u32,
    /// How scenes are rendered.
    pub render: RenderSettings,
    /// Where files go.
    pub out: PathBuf,
    /// Whether the scores of filters get intervals, by which bounds are judged. Takes a few more measurements of every
    /// picture.
    pub intervals: bool,
    /// Whether frames, truths and cases that lie in `out` are removed and made anew.
    pub no_cache: bool,
    /// The shutter alignment that every case is compared with; none for that of [`Run::common_alignment`].
    pub common: Option<Alignment>,
    /// What is told of the progress, and what ends the work.
    pub monitor: Monitor,
}

impl Plan {
    /// The alignments that take part, each once.
    pub(crate) fn alignments(&self) -> Vec<Alignment> {
        let takes_part = |alignment: &Alignment| {
            Some(*alignment) == self.common
                || (self.filters.iter()).any(|choice| choice.filter.alignment == *alignment)
        };
        Alignment::ALL.into_iter().filter(takes_part).collect()
    }

    /// The alignment that every case is compared with.
    fn common_alignment(&self) -> Alignment {
        (self.common).unwrap_or_else(|| common_alignment(&self.alignments()))
    }
}

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself; what was measured of the same
/// inputs before, and lies there still, is read back. `gpu` is what [`open_gpu`](crate::open_gpu) opened for the plan's
/// filters.
pub fn run(plan: &Plan, gpu: Option<&Gpu>, command: Vec<String>) -> Result<Run, Error> {
    let common = plan.common_alignment();
    // A single scene's own steps tell everything.
    let monitor = match plan.scenes.len() {
        1 => plan.monitor.unseen(),
        _ => plan.monitor,
    };
    let label = format!("{} scenes in all", plan.scenes.len());
    let (cases, failures, read_back) =
        monitor.watch(&label, |watch| all_cases(plan, gpu, watch))?;
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
        common_alignment: common.name().to_owned(),
        overall: overall(&cases),
        failures,
        cases,
        read_back,
    })
}

/// Measures scene after scene; counts the cases that were read back.
fn all_cases(
    plan: &Plan,
    gpu: Option<&Gpu>,
    watch: Watch,
) -> Result<(Vec<Case>, Vec<Failure>, usize), Error> {
    let filters = scale_filters(plan);
    let (mut cases, mut failures, mut read_back) = (Vec::new(), Vec::new(), 0);
    for (scene, scene_run) in (0..).zip(scene_runs(plan, &filters, gpu)) {
        let steps = scene_run.steps();
        let advance = |done: u64| {
            // A scene that is interrupted says so itself.
            let _ = watch(Progress {
                done: scene * steps + done.min(steps),
                total: plan.scenes.len() as u64 * steps,
            });
        };
        advance(0);
        let (all, kept) = scene_run.cases(&advance)?;
        read_back += kept;
        for case in all {
            match case {
                Ok(case) => cases.push(case),
                Err(failure) => failures.push(failure),
            }
        }
    }
    Ok((cases, failures, read_back))
}

/// Scales the filters of a plan to its pictures.
fn scale_filters(plan: &Plan) -> Vec<FilterChoice> {
    let width = plan.render.width;
    (plan.filters.iter())
        .map(|choice| choice.scaled_to(width))
        .collect()
}

/// Makes the runs of all scenes of a plan, ready to begin.
fn scene_runs<'a>(
    plan: &'a Plan,
    filters: &'a [FilterChoice],
    gpu: Option<&'a Gpu>,
) -> Vec<SceneRun<'a>> {
    let program = hash_of_program();
    let scene_run = |scene: &'a Scene| SceneRun {
        plan,
        filters,
        gpu,
        scene,
        common: plan.common_alignment(),
        inputs: (program.as_ref())
            .map(|program| SceneInputs::new(program, scene, &plan.render, plan.alignments())),
    };
    plan.scenes.iter().map(scene_run).collect()
}

/// Of the alignments that take part, the one that all are compared with; no truth is rendered for it alone.
fn common_alignment(taking_part: &[Alignment]) -> Alignment {
    [Alignment::Centred, Alignment::Trailing]
        .into_iter()
        .find(|alignment| taking_part.contains(alignment))
        .unwrap_or(Alignment::Leading)
}

/// The photographic exposures that a scene is compared at.
pub fn viewing(scene: &Scene) -> Viewing {
    scene.display.into()
}
