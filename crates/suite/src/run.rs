//! The main job: render every scene, run every filter on it, measure how far each picture is from the truth.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use filters::{AdapterDescription, Command, FilterError, Gpu, Value};
use frame::{Alignment, Frame, Ladder, Truth};
use metrics::{Measurement, Reference, Scores, Viewing};
use serde::{Deserialize, Serialize};
use tracer::{Family, Scene};

use crate::bounds::{Bounds, Verdict, judge};
use crate::pictures::{write_case, write_scene};
use crate::probe::picture;
use crate::progress::interrupted;
use crate::rendered::{frame_of, scene_folder, truth_and_ladder_of};
use crate::selection::FilterChoice;
use crate::{Error, PROGRAM, RenderSettings, Runner};

/// Version of the layout of `run.json`; it rises when a reader of the old one would misread the new one.
pub const FORMAT: u32 = 1;

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
    /// One per scene and filter preset, in the order they ran.
    pub cases: Vec<Case>,
}

/// One filter preset on one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Scene, with its variant: `sliding_panel@64px_45deg`.
    pub scene: String,
    /// The scene's family.
    pub family: Family,
    /// What the scene exposes.
    pub exposes: String,
    /// Exposure in frames.
    pub exposure: f64,
    /// Filter name.
    pub filter: String,
    /// The preset that the parameters started from.
    pub preset: String,
    /// Every parameter's value.
    pub parameters: BTreeMap<String, Value>,
    /// Program and arguments of a filter that is a command, as filter.toml has them. What the program itself does is
    /// recorded nowhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<Vec<String>>,
    /// The shutter alignment that the filter declares and is scored against.
    pub alignment: String,
    /// Hash of the truth's inputs: equal hashes mean equal truths.
    pub truth_hash: String,
    /// The measured scores, each with its noise floor.
    pub scores: Scores,
    /// How the scores stand to the scene's bounds.
    pub verdicts: Vec<Verdict>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub folder: PathBuf,
}

/// What a run is to do.
pub struct Plan {
    /// Loaded scenes, each with its bounds.
    pub scenes: Vec<(Scene, Bounds)>,
    /// Loaded filters.
    pub filters: Vec<FilterChoice>,
    /// How scenes are rendered.
    pub render: RenderSettings,
    /// Where files go.
    pub out: PathBuf,
    /// No progress bars.
    pub quiet: bool,
}

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself. `gpu` is what
/// [`open_gpu`](crate::open_gpu) opened for the plan's filters.
pub fn run(plan: &Plan, gpu: Option<&Gpu>, command: Vec<String>) -> Result<Run, Error> {
    let mut cases = Vec::new();
    for (scene, bounds) in &plan.scenes {
        let (frame, truths) = render(plan, scene)?;
        let folder = scene_folder(&plan.out, scene);
        write_scene(
            &folder,
            scene,
            &frame,
            truths.values().map(|(truth, _)| truth),
        )?;
        let references = references(scene, &frame.cropped(), &truths)?;
        for choice in &plan.filters {
            if interrupted() {
                return Err(tracer::TraceError::Cancelled.into());
            }
            let (truth, _) = &truths[&choice.filter.alignment];
            let reference = &references[&choice.filter.alignment];
            cases.push(run_case(
                plan,
                gpu,
                scene,
                bounds,
                (&frame, truth, reference),
                choice,
            )?);
        }
    }
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
        cases,
    })
}

type Truths = BTreeMap<Alignment, (Truth, Ladder)>;

/// The scene's frame and one truth per alignment that a filter of the plan declares.
fn render(plan: &Plan, scene: &Scene) -> Result<(Frame, Truths), Error> {
    let frame = frame_of(scene, &plan.render, &plan.out, plan.quiet)?;
    let mut truths = Truths::new();
    for alignment in Alignment::ALL {
        if plan
            .filters
            .iter()
            .any(|choice| choice.filter.alignment == alignment)
        {
            let made = truth_and_ladder_of(scene, &plan.render, alignment, &plan.out, plan.quiet)?;
            truths.insert(alignment, made);
        }
    }
    Ok((frame, truths))
}

fn references<'a>(
    scene: &Scene,
    frame: &Frame,
    truths: &'a Truths,
) -> Result<BTreeMap<Alignment, Reference<'a>>, Error> {
    truths
        .iter()
        .map(|(alignment, (truth, ladder))| {
            Ok((
                *alignment,
                Reference::new(frame, truth, Some(ladder), &viewing(scene))?,
            ))
        })
        .collect()
}

fn run_case(
    plan: &Plan,
    gpu: Option<&Gpu>,
    scene: &Scene,
    bounds: &Bounds,
    (frame, truth, reference): (&Frame, &Truth, &Reference),
    choice: &FilterChoice,
) -> Result<Case, Error> {
    let mut runner = Runner::new(gpu, choice, frame.size())?;
    let output = picture(&mut runner, frame, 0)
        .map_err(|error| on_scene(error, scene))?
        .cropped(frame.guard_band);
    let Measurement { scores, maps } = reference.measure(&output)?;
    let folder = Path::new(&scene.name).join(choice.name().replace(':', "_"));
    write_case(
        &plan.out.join(&folder),
        scene,
        &frame.objects,
        &output,
        &maps,
    )?;
    Ok(Case {
        scene: scene.name.clone(),
        family: scene.family,
        exposes: scene.exposes.clone(),
        exposure: frame.exposure,
        filter: choice.filter.name.clone(),
        preset: choice.preset.clone(),
        parameters: choice.settings.values.clone(),
        command: choice.filter.command.as_ref().map(Command::words),
        alignment: choice.filter.alignment.name().to_owned(),
        truth_hash: truth.provenance.content_hash.clone(),
        verdicts: judge(&scores, bounds),
        scores,
        folder,
    })
}

/// A program may fail on one scene and not on another.
fn on_scene(error: FilterError, scene: &Scene) -> FilterError {
    match error {
        FilterError::Command { filter, reason } => FilterError::Command {
            filter: format!("{filter} on {}", scene.name),
            reason,
        },
        other => other,
    }
}

/// The photographic exposures that a scene is compared at.
pub fn viewing(scene: &Scene) -> Viewing {
    scene.display.into()
}
