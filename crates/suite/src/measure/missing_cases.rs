//! Measurement of the cases of one scene that no earlier run left, against one truth after another.

use std::collections::BTreeMap;

use filters::FilterError;
use frame::{Accumulation, Alignment, Frame, Ladder, Truth};
use metrics::{ColorReference, Reference};
use store::put;
use tracer::{Defocus, Progress, Scene, Watch};

use super::case::{CaseContext, CommonTruth};
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::references::TruthReferences;
use super::run_scene::RunScene;
use super::scene::SceneContext;
use super::stored_frames::store_frames;
use crate::Error;
use crate::inputs::depth_of_field::DepthOfField;
use crate::inputs::input_format::InputFormat;
use crate::render::ladders::{LadderFiles, SHARP, needed_rungs};
use crate::render::replicates::TruthFiles;
use crate::render::truths::render_truth;
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::stats::intervals::truths_without_pairs;

impl SceneContext<'_> {
    /// Measures some cases, and writes the record of each as soon as it is whole.
    pub(super) fn measure(
        &self,
        missing: &[&PlannedCase],
        frame: &Frame,
        advance: &dyn Fn(u64),
        watch: Watch,
    ) -> Result<Vec<Result<Case, Failure>>, Error> {
        advance(self.render_steps());
        if missing.is_empty() {
            return Ok(Vec::new());
        }
        let viewing = frame.display.into();
        let is_needed = |input: &&InputFormat| missing.iter().any(|case| case.id.input == **input);
        let inputs: Vec<InputFormat> = self.plan.inputs.iter().filter(is_needed).copied().collect();
        let stored_frames = store_frames(self.plan, self.filters, self.scene, &inputs, frame)?;
        let depth_of_field = self.prepare_passes(&inputs, frame)?;
        let common_alignment = self.plan.common_alignment();
        let has_others = (missing.iter()).any(|case| case.id.alignment != common_alignment);
        // Truths take turns in memory. The common one comes first, since its colours stay.
        let mut alignments = self.scene.alignments(self.plan.alignments());
        alignments.sort_by_key(|alignment| *alignment != common_alignment);
        let mut common: Option<ColorReference> = None;
        let mut cases = BTreeMap::new();
        for alignment in alignments {
            let is_common = alignment == common_alignment;
            let own: Vec<(usize, &&PlannedCase)> = (missing.iter().enumerate())
                .filter(|(_, case)| case.id.alignment == alignment)
                .collect();
            if own.is_empty() && !is_common {
                continue;
            }
            let truth = self.read_truth(alignment)?;
            if own.is_empty() {
                // Only FLIP is measured against it, which needs no ladder and no oracle.
                common = Some(Reference::new(&frame.cropped(), &truth, None, &viewing)?.into());
                continue;
            }
            let has_filters = own.iter().any(|(_, case)| !case.id.is_reference);
            let without_pairs = match has_filters && self.plan.intervals {
                true => self.truths_without_pairs(alignment)?,
                false => Vec::new(),
            };
            let references = TruthReferences::new(
                frame,
                &truth,
                || self.read_sharp(&truth),
                self.read_rungs(&truth),
                &without_pairs,
                &viewing,
            )?;
            for (at, planned) in own {
                let progress = Progress {
                    done: cases.len() as u64,
                    total: missing.len() as u64,
                };
                if watch(progress).is_break() {
                    return Err(tracer::TraceError::Cancelled.into());
                }
                let context = CaseContext {
                    plan: self.plan,
                    gpu: self.gpu,
                    scene: self.scene,
                    frame,
                    stored_frames: &stored_frames,
                    depth_of_field: depth_of_field.as_ref(),
                    references: &references,
                    read_rung: &|subframes| self.read_rung(&truth, subframes),
                    common: match &common {
                        _ if is_common => CommonTruth::Own,
                        Some(reference) => CommonTruth::Other(reference),
                        None => CommonTruth::Missing,
                    },
                };
                cases.insert(at, self.measure_case(&context, planned)?);
            }
            if is_common && has_others {
                common = Some(references.reference.into());
            }
        }
        Ok(cases.into_values().collect())
    }

    /// Prepares the pass of depth of field behind filters; none where all of them come last.
    fn prepare_passes(
        &self,
        inputs: &[InputFormat],
        frame: &Frame,
    ) -> Result<Option<Defocus>, Error> {
        let last = inputs.iter().map(|input| input.depth_of_field);
        let mut last = last.filter(|place| *place == DepthOfField::After);
        match (last.next(), self.scene.traced()) {
            (Some(place), Some(scene)) => place.prepare_pass(frame, scene, self.plan.monitor),
            _ => Ok(None),
        }
    }

    /// Measures a case and writes its record; a failure where it concerns this case alone.
    fn measure_case(
        &self,
        context: &CaseContext,
        planned: &PlannedCase,
    ) -> Result<Result<Case, Failure>, Error> {
        let (case, files) = match context.measure(planned) {
            Ok(measured) => measured,
            Err(error) => return Ok(Err(self.failure(error, planned)?)),
        };
        if let Some(key) = self.case_key(planned) {
            put(&self.case_record(planned), key, &files, &case)?;
        }
        Ok(Ok(case))
    }

    /// Turns an error that concerns one case into its failure. Any other error ends the run and comes back.
    fn failure(&self, error: Error, planned: &PlannedCase) -> Result<Failure, Error> {
        match &error {
            Error::Filter(FilterError::Gpu { .. } | FilterError::Command { .. })
            | Error::Measure(_) => Ok(Failure {
                scene: planned.id.scene.clone(),
                filter: planned.id.name(),
                alignment: planned.id.alignment,
                reason: error.to_string(),
            }),
            _ => Err(error),
        }
    }

    /// Reads a truth, or renders it; copies that which an engine drew.
    pub(super) fn read_truth(&self, alignment: Alignment) -> Result<Truth, Error> {
        let RunPlan { render, out, .. } = self.plan;
        match self.scene {
            RunScene::Traced(scene) => {
                render_truth(scene, render, alignment, out, self.plan.monitor)
            }
            RunScene::Drawn(scene) => scene.copy_truth(&self.folder()),
        }
    }

    /// Renders those rungs of the ladder of a truth that the plan needs and are missing; an engine's are copied with its truth.
    pub(super) fn ensure_ladder(&self, truth: &Truth) -> Result<(), Error> {
        match self.scene {
            RunScene::Traced(scene) => {
                let rungs = needed_rungs(truth.alignment, self.plan.ladders);
                self.ladder(scene, truth).ensure(rungs, self.plan.monitor)
            }
            RunScene::Drawn(_) => Ok(()),
        }
    }

    /// Reads the rung that is the sharp picture of the shutter's middle, or renders it.
    fn read_sharp(&self, truth: &Truth) -> Result<Accumulation, Error> {
        Ok(self.read_rung(truth, SHARP)?.rungs.remove(0))
    }

    /// Reads the rungs of the ladder of a truth, one after another.
    fn read_rungs(&self, truth: &Truth) -> impl Iterator<Item = Result<Ladder, Error>> {
        let rungs = self.scene.rungs(self.plan.ladders);
        rungs.iter().map(|rung| self.read_rung(truth, *rung))
    }

    /// Reads a rung of the ladder of a truth, or renders it.
    fn read_rung(&self, truth: &Truth, subframes: u32) -> Result<Ladder, Error> {
        match self.scene {
            RunScene::Traced(scene) => {
                let ladder = self.ladder(scene, truth);
                ladder.read_or_render(subframes, self.plan.monitor)
            }
            RunScene::Drawn(scene) => scene.read_rung(&self.folder(), subframes),
        }
    }

    fn ladder<'s>(&self, scene: &'s Scene, truth: &'s Truth) -> LadderFiles<'s> {
        LadderFiles::new(scene, &self.plan.render, truth, &self.plan.out)
    }

    /// Makes the truths of an alignment without one pair of replicates each. None of what an engine drew: sub-frames are no random
    /// samples, and those without some of them have holes.
    fn truths_without_pairs(&self, alignment: Alignment) -> Result<Vec<Truth>, Error> {
        let RunScene::Traced(scene) = self.scene else {
            return Ok(Vec::new());
        };
        let RunPlan { render, out, .. } = self.plan;
        let files = TruthFiles::new(scene, render, alignment, out, self.plan.monitor);
        let replicates = files.replicates(0..render.replicates)?;
        Ok(truths_without_pairs(&replicates)?)
    }
}
