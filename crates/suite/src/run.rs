//! The main job: render every scene, run every filter on it, measure how far each picture is from the truth.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use filters::{AdapterDescription, Gpu};
use frame::{Alignment, FileError, Frame, Ladder, Truth};
use metrics::{MeasureError, Reference, Viewing};
use serde::{Deserialize, Serialize};
use tracer::Scene;

use crate::bounds::SceneBounds;
use crate::case::Case;
use crate::overall::{Overall, overall};
use crate::pictures::write_scene;
use crate::progress::interrupted;
use crate::rendered::{frame_of, replicates_of, scene_folder, truth_and_ladder_of};
use crate::selection::FilterChoice;
use crate::witness::Witness;
use crate::workbench::Workbench;
use crate::{Error, InputFormat, PROGRAM, RenderSettings, truths_without_pairs};

/// Version of the layout of `run.json`; it rises when a reader of the old one would misread the new one.
pub const FORMAT: u32 = 3;

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
    /// Means over the scenes.
    #[serde(default)]
    pub overall: Vec<Overall>,
}

impl Run {
    /// Reads a `run.json` of this program.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text =
            std::fs::read_to_string(path).map_err(|source| FileError::io(path, "read", source))?;
        let refuse = |reason: String| {
            Error::Usage(format!(
                "{}: {reason}; `shuttertruth run` or `check` writes one",
                path.display()
            ))
        };
        let run: Self = serde_json::from_str(&text)
            .map_err(|error| refuse(format!("no run of this program: {error}")))?;
        match run.format {
            FORMAT => Ok(run),
            other => Err(refuse(format!("has format {other}; allowed: {FORMAT}"))),
        }
    }
}

/// What a run is to do.
pub struct Plan {
    /// Loaded scenes, each with its bounds.
    pub scenes: Vec<(Scene, SceneBounds)>,
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
    /// Whether bounds that are not kept get the place where the picture is worst, and what it is like.
    pub evidence: bool,
    /// No progress bars.
    pub quiet: bool,
}

/// Renders, filters, measures and writes every case below `plan.out`, but not `run.json` itself. `gpu` is what
/// [`open_gpu`](crate::open_gpu) opened for the plan's filters.
pub fn run(plan: &Plan, gpu: Option<&Gpu>, command: Vec<String>) -> Result<Run, Error> {
    let common = common_alignment(&plan.filters);
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
        let cropped = frame.cropped();
        let references = references(scene, &cropped, &truths)?;
        let parts = match plan.intervals {
            true => parts(plan, scene, &truths)?,
            false => Parts::new(),
        };
        let without = (parts.iter())
            .map(|(alignment, parts)| {
                let whole = &references[alignment];
                let reference = |part| {
                    let ladder = Some(&truths[alignment].1);
                    // What is left out changes scores, not where they are taken.
                    let regions = whole.regions.clone();
                    Reference::over(regions, &cropped, part, ladder, &viewing(scene))
                };
                let references: Result<_, MeasureError> = parts.iter().map(reference).collect();
                Ok((*alignment, references?))
            })
            .collect::<Result<BTreeMap<_, Vec<Reference>>, Error>>()?;
        let witnesses: BTreeMap<Alignment, Witness> = (truths.iter())
            .filter(|_| plan.evidence)
            .map(|(alignment, (truth, ladder))| {
                (*alignment, Witness::new(scene, &cropped, truth, ladder))
            })
            .collect();
        let stored: Vec<(InputFormat, Frame)> = (plan.inputs.iter())
            .map(|format| (*format, format.of(&frame)))
            .collect();
        let workbench = |alignment| {
            let (truth, ladder) = &truths[&alignment];
            Workbench {
                plan,
                scene,
                bounds,
                truth,
                ladder,
                reference: &references[&alignment],
                common: (alignment != common).then(|| &references[&common]),
                without: without.get(&alignment).map(Vec::as_slice),
                witness: witnesses.get(&alignment),
            }
        };
        for alignment in truths.keys() {
            cases.extend(workbench(*alignment).bars(&frame)?);
        }
        for choice in &plan.filters {
            let workbench = workbench(choice.filter.alignment);
            for (format, frame) in &stored {
                if interrupted() {
                    return Err(tracer::TraceError::Cancelled.into());
                }
                cases.push(workbench.filter(gpu, choice, *format, frame)?);
            }
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
        common_alignment: common.name().to_owned(),
        overall: overall(&cases),
        cases,
    })
}

/// Of the alignments that take part, the one that all are compared with; no truth is rendered for it alone.
fn common_alignment(filters: &[FilterChoice]) -> Alignment {
    let takes_part = |alignment: &Alignment| {
        (filters.iter()).any(|choice| choice.filter.alignment == *alignment)
    };
    [Alignment::Centred, Alignment::Trailing]
        .into_iter()
        .find(takes_part)
        .unwrap_or(Alignment::Leading)
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

/// Per alignment, the truths that all replicates but a pair each make.
type Parts = BTreeMap<Alignment, Vec<Truth>>;

fn parts(plan: &Plan, scene: &Scene, truths: &Truths) -> Result<Parts, Error> {
    (truths.iter())
        .map(|(alignment, (truth, _))| {
            let replicates = replicates_of(scene, &plan.render, *alignment, &plan.out, plan.quiet)?;
            Ok((*alignment, truths_without_pairs(truth, &replicates)?))
        })
        .collect()
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

/// The photographic exposures that a scene is compared at.
pub fn viewing(scene: &Scene) -> Viewing {
    scene.display.into()
}
