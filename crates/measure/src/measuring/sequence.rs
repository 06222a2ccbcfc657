//! Scores of sequences, from the pictures of the frames' cases.

use scene::Scene;

use crate::{Error, RenderFile, RenderPath};
use frame::{
    Alignment, Image, Truth, read_exr, read_png, tile_pictures, write_animated_png, write_png,
};
use metrics::{Instant, SequenceReference, SequenceScores};
use tracer::PointLayers;

use super::pictures::{PARTS_FILE, part_layer};
use super::plan::RunPlan;
use super::points_of_frame::{make_instant, trace_points};
use crate::colors::magma;
use crate::run::case::{Case, Intervals};
use crate::run::sequence::{Sequence, SequenceFrame, worst_frames};
use crate::stats::intervals::sequence_intervals;
use crate::stats::parts::Groups;

/// Picture of the error of the change since the previous frame, next to a case's other pictures.
pub const CHANGE_PICTURE: &str = "change.png";
/// Animation of a sequence, next to the pictures of its first frame.
pub const SEQUENCE_PICTURE: &str = "sequence.png";

/// Measures a scene's sequences, one per case that every frame has. `frames` lists the cases of
/// each frame.
pub(super) fn measure_sequences(
    plan: &RunPlan,
    frames: &[Vec<Case>],
) -> Result<Vec<Sequence>, Error> {
    let mut sequences = Vec::new();
    let id = frames[0].first().map(|case| &case.scene);
    let Some(scene) = plan.scenes.iter().find(|scene| Some(&scene.id) == id) else {
        // No case of the first frame was measured.
        return Ok(sequences);
    };
    let layers: Vec<PointLayers> = (0..plan.frames.count)
        .map(|frame| trace_points(&scene.at_frame(frame), &plan.render))
        .collect::<Result<_, _>>()?;
    for alignment in Alignment::ALL {
        let is_own = |case: &&Case| case.alignment == alignment;
        let mut first = frames[0].iter().filter(is_own).peekable();
        if first.peek().is_none() {
            continue;
        }
        let truths = SequenceTruths {
            plan,
            scene,
            alignment,
            layers: &layers,
        };
        // A case that failed in a frame, which the run reports, has no sequence.
        let all: Vec<Vec<&Case>> = first.filter_map(|case| find_in_all(frames, case)).collect();
        sequences.extend(truths.measure(&all)?);
    }
    Ok(sequences)
}

/// Lists all frames' cases that match one of the first frame; none if a frame lacks it.
fn find_in_all<'a>(frames: &'a [Vec<Case>], first: &Case) -> Option<Vec<&'a Case>> {
    let is_like = |case: &&Case| case.filter_id() == first.filter_id();
    let matches = frames.iter().map(|cases| cases.iter().find(is_like));
    matches.collect()
}

/// The truths of one scene and shutter, in order of frames.
struct SequenceTruths<'a> {
    plan: &'a RunPlan,
    scene: &'a Scene,
    alignment: Alignment,
    layers: &'a [PointLayers],
}

impl SequenceTruths<'_> {
    /// Measures the sequences of cases; each entry lists all frames' cases.
    fn measure(&self, all: &[Vec<&Case>]) -> Result<Vec<Sequence>, Error> {
        let reference = self.whole()?;
        let mut sequences: Vec<Sequence> = (all.iter())
            .map(|cases| measure_sequence(self.plan, &reference, cases))
            .collect::<Result<_, _>>()?;
        drop(reference);
        let intervals = self.intervals(&sequences, all)?;
        for (sequence, intervals) in sequences.iter_mut().zip(intervals) {
            sequence.intervals = intervals;
        }
        Ok(sequences)
    }

    /// Computes the intervals of filters' scores; empty for references, and if not requested. One
    /// truth at a time is in memory.
    fn intervals(
        &self,
        sequences: &[Sequence],
        all: &[Vec<&Case>],
    ) -> Result<Vec<Intervals>, Error> {
        let has_intervals = |sequence: &Sequence| self.plan.intervals && !sequence.is_reference;
        let mut parts: Vec<Vec<SequenceScores>> = vec![Vec::new(); sequences.len()];
        if sequences.iter().any(has_intervals) {
            let groups = Groups::of(self.plan.render.replicates);
            for group in groups.list() {
                let reference = self.without(groups, group)?;
                let all = sequences.iter().zip(all).zip(&mut parts);
                for ((_, cases), scores) in all.filter(|((sequence, _), _)| has_intervals(sequence))
                {
                    let outputs = self.plan.read_part_outputs(cases, group)?;
                    scores.push(reference.measure(&outputs)?.scores);
                }
            }
        }
        let both = sequences.iter().zip(&parts);
        Ok(both
            .map(|(sequence, parts)| sequence_intervals(&sequence.scores, parts))
            .collect())
    }

    /// Reads the truths of all frames.
    fn whole(&self) -> Result<SequenceReference, Error> {
        self.reference(|scene| {
            let path = RenderPath {
                scene: scene.id.clone(),
                file: RenderFile::Truth(self.alignment),
            };
            Ok(Truth::read(&self.plan.out.join(path.path()))?)
        })
    }

    /// Makes the truths of all frames without one group of their replicates.
    fn without(&self, groups: Groups, group: usize) -> Result<SequenceReference, Error> {
        self.reference(|scene| {
            let files = self.plan.rendering(scene.into()).files(self.alignment);
            let replicates = files.replicates(0..self.plan.render.replicates)?;
            Ok(groups.truth_without(group, &replicates)?)
        })
    }

    fn reference(
        &self,
        truth: impl Fn(&Scene) -> Result<Truth, Error>,
    ) -> Result<SequenceReference, Error> {
        let instants = (0..).zip(self.layers).map(|(frame, layer)| {
            let truth = truth(&self.scene.at_frame(frame))?;
            Ok(make_instant(&truth, layer.clone()))
        });
        Ok(SequenceReference::new(
            instants.collect::<Result<Vec<Instant>, Error>>()?,
            &self.scene.display.into(),
            self.plan.frames.shown(&self.scene.id),
        ))
    }
}

impl RunPlan {
    /// Reads the colours of a sequence's pictures, in order of frames.
    fn read_outputs(&self, cases: &[&Case]) -> Result<Vec<Image>, Error> {
        let paths = cases
            .iter()
            .map(|case| self.out.join(&case.folder).join("output.exr"));
        paths.map(|path| Ok(read_exr(&path)?.color("")?)).collect()
    }

    /// Reads the colours of a sequence's pictures of the frames without one group of their
    /// replicates.
    fn read_part_outputs(&self, cases: &[&Case], group: usize) -> Result<Vec<Image>, Error> {
        let paths = (cases.iter()).map(|case| self.out.join(&case.folder).join(PARTS_FILE));
        (paths.map(|path| Ok(read_exr(&path)?.color(&part_layer(group))?))).collect()
    }
}

fn measure_sequence(
    plan: &RunPlan,
    reference: &SequenceReference,
    all: &[&Case],
) -> Result<Sequence, Error> {
    let first = all[0];
    let measured = reference.measure(&plan.read_outputs(all)?)?;
    let shown = plan.frames.shown(&first.scene);
    write_animation(plan, first, all, shown)?;
    for (case, map) in all[1..].iter().zip(&measured.change_errors) {
        let path = plan.out.join(&case.folder).join(CHANGE_PICTURE);
        write_png(&path, &magma(&map.map(|error| error.sqrt())))?;
    }
    let frames = (all.iter().zip(&measured.errors).zip(&measured.flickers)).map(
        |((case, error), flicker)| SequenceFrame {
            scene: case.scene.folder(),
            folder: case.folder.clone(),
            truth_hash: case.truth_hash.clone(),
            error: *error,
            flicker: *flicker,
        },
    );
    Ok(Sequence {
        scene: first.scene.clone(),
        filter: first.filter_id(),
        frames: frames.collect(),
        worst_frames: worst_frames(&measured),
        intervals: Intervals::new(),
        scores: measured.scores,
    })
}

/// Writes the frames of a case as an animation, side by side: instant, truth, output, and FLIP.
fn write_animation(
    plan: &RunPlan,
    first: &Case,
    all: &[&Case],
    per_second: f64,
) -> Result<(), Error> {
    let truth = RenderFile::Truth(first.alignment).picture();
    let strips = all.iter().map(|case| {
        let [scene, folder] = [
            plan.out.join(case.scene.folder()),
            plan.out.join(&case.folder),
        ];
        let pictures = [
            scene.join(RenderFile::Frame.picture()),
            scene.join(&truth),
            folder.join("output.png"),
            folder.join("flip.png"),
        ];
        let pictures = pictures.iter().map(|path| read_png(path));
        let pictures = pictures.collect::<Result<Vec<Image>, _>>()?;
        Ok(tile_pictures(&pictures, pictures.len() as u32, 0, [0.0; 3]))
    });
    let strips = strips.collect::<Result<Vec<Image>, Error>>()?;
    let path = plan.out.join(&first.folder).join(SEQUENCE_PICTURE);
    Ok(write_animated_png(&path, &strips, per_second)?)
}
