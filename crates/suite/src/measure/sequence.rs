//! Scores of sequences, from the pictures that the frames' cases left.

use std::path::{Path, PathBuf};

use frame::{
    Alignment, FrameOptions, Image, Raster, Truth, VelocityKind, read_exr, read_png,
    write_animated_png, write_png,
};
use metrics::{Instant, SequenceReference};
use tracer::{PointMotion, RenderSettings, Scene, trace_motion};

use super::plan::RunPlan;
use crate::Error;
use crate::colors::magma;
use crate::run::case::Case;
use crate::run::sequence::{Sequence, SequenceFrame};

/// Picture of the error of the change since the frame before, beside a case's other pictures.
pub const CHANGE_PICTURE: &str = "change.png";
/// Animation of a sequence, beside the pictures of its first frame.
pub const SEQUENCE_PICTURE: &str = "sequence.png";

/// Cases of all frames of one scene, in the order of the frames.
#[derive(Default)]
pub(super) struct FrameCases {
    /// Cases of each frame.
    pub cases: Vec<Vec<Case>>,
}

/// Measures the sequences of a scene whose frames were measured: one per case that every frame has.
pub(super) fn measure_sequences(
    plan: &RunPlan,
    frames: &FrameCases,
) -> Result<Vec<Sequence>, Error> {
    let mut sequences = Vec::new();
    let name = |case: &Case| case.scene.clone();
    let name = frames.cases[0].first().map(name);
    let Some(scene) = plan
        .scenes
        .iter()
        .find(|scene| Some(&scene.name) == name.as_ref())
    else {
        // No case of the first frame was measured.
        return Ok(sequences);
    };
    let layers: Vec<PointsOfFrame> = (0..plan.frames.count)
        .map(|frame| PointsOfFrame::trace(&scene.at_frame(frame), &plan.render))
        .collect::<Result<_, _>>()?;
    for alignment in Alignment::ALL {
        let is_due = |case: &&Case| case.alignment == alignment.name();
        let first: Vec<&Case> = frames.cases[0].iter().filter(is_due).collect();
        if first.is_empty() {
            continue;
        }
        let reference = make_reference(plan, scene, alignment, &layers)?;
        for case in first {
            let Some(all) = frames.all_of(case) else {
                // It failed in one of them, which the run says.
                continue;
            };
            sequences.push(measure_sequence(plan, &reference, case, &all)?);
        }
    }
    Ok(sequences)
}

impl FrameCases {
    /// Lists the cases of all frames that are like one of the first; none where a frame lacks it.
    fn all_of<'a>(&'a self, first: &'a Case) -> Option<Vec<&'a Case>> {
        let like = |case: &&Case| {
            case.is_reference == first.is_reference
                && case.name() == first.name()
                && case.alignment == first.alignment
        };
        (self.cases.iter())
            .map(|cases| cases.iter().find(like))
            .collect()
    }
}

/// What a rasteriser writes of one frame, with the motion since the frame before.
struct PointsOfFrame {
    scene: String,
    points: tracer::PointLayers,
}

impl PointsOfFrame {
    fn trace(scene: &Scene, render: &RenderSettings) -> Result<Self, Error> {
        let settings = RenderSettings {
            options: FrameOptions {
                velocity: VelocityKind::PreviousFrame,
                ..FrameOptions::default()
            },
            guard_band: 0,
            ..*render
        };
        Ok(Self {
            scene: scene.name.clone(),
            points: trace_motion(scene, &settings, &PointMotion::RIGHT)?,
        })
    }
}

/// Reads the truths of all frames.
fn make_reference(
    plan: &RunPlan,
    scene: &Scene,
    alignment: Alignment,
    layers: &[PointsOfFrame],
) -> Result<SequenceReference, Error> {
    let instants = layers.iter().map(|layer| {
        let path = (plan.out.join(&layer.scene)).join(format!("truth_{alignment}.exr"));
        let points = layer.points.clone();
        Ok(Instant::new(
            &Truth::read(&path)?,
            points.velocity,
            points.depth,
            points.object_id,
        ))
    });
    let instants = instants.collect::<Result<Vec<Instant>, Error>>()?;
    Ok(SequenceReference::new(
        instants,
        &scene.display.into(),
        plan.frames.per_second,
    ))
}

fn measure_sequence(
    plan: &RunPlan,
    reference: &SequenceReference,
    first: &Case,
    all: &[&Case],
) -> Result<Sequence, Error> {
    let pictures: Vec<Image> = (all.iter())
        .map(|case| read_picture(&plan.out.join(&case.folder)))
        .collect::<Result<_, _>>()?;
    let measured = reference.measure(&pictures)?;
    write_animation(plan, first, all)?;
    for (case, map) in all[1..].iter().zip(&measured.change_errors) {
        let path = plan.out.join(&case.folder).join(CHANGE_PICTURE);
        write_png(&path, &magma(&map.map(|error| error.sqrt())))?;
    }
    let frames = (all.iter().zip(&measured.errors).zip(&measured.flickers)).map(
        |((case, error), flicker)| SequenceFrame {
            scene: PathBuf::from(&case.scene),
            folder: case.folder.clone(),
            truth_hash: case.truth_hash.clone(),
            error: *error,
            flicker: *flicker,
        },
    );
    Ok(Sequence {
        scene: first.scene.clone(),
        filter: first.name(),
        is_reference: first.is_reference,
        alignment: first.alignment.clone(),
        frames: frames.collect(),
        scores: measured.scores,
    })
}

/// Writes the frames of a case as an animation, side by side: instant, truth, output, and FLIP.
fn write_animation(plan: &RunPlan, first: &Case, all: &[&Case]) -> Result<(), Error> {
    let truth = format!("truth_{}.png", first.alignment);
    let strips = all.iter().map(|case| {
        let [scene, own] = [plan.out.join(&case.scene), plan.out.join(&case.folder)];
        let pictures = [
            scene.join("frame.png"),
            scene.join(&truth),
            own.join("output.png"),
            own.join("flip.png"),
        ];
        let pictures = pictures.iter().map(|path| read_png(path));
        Ok(beside(&pictures.collect::<Result<Vec<Image>, _>>()?))
    });
    let strips = strips.collect::<Result<Vec<Image>, Error>>()?;
    let path = plan.out.join(&first.folder).join(SEQUENCE_PICTURE);
    Ok(write_animated_png(&path, &strips, plan.frames.per_second)?)
}

/// Places pictures of one size side by side.
fn beside(pictures: &[Image]) -> Image {
    let width = pictures[0].width;
    let all = width * pictures.len() as u32;
    Raster::from_fn(all, pictures[0].height, |x, y| {
        *pictures[(x / width) as usize].at(x % width, y)
    })
}

/// Reads the colour of a picture that a case left.
fn read_picture(folder: &Path) -> Result<Image, Error> {
    Ok(read_exr(&folder.join("output.exr"))?.color("")?)
}
