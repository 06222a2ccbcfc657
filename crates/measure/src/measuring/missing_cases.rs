//! Measurement of the cases of one scene that no earlier run left, one truth at a time.

use std::collections::BTreeMap;

use crate::{Error, SHARP, errors_file, look_up, put};
use filters::FilterError;
use frame::{Alignment, Frame, Ladder, Picture, Truth};
use metrics::{ColorReference, Reference};
use tracer::{Defocus, Progress, TraceError, Watch};

use super::attempt::Attempt;
use super::case::{CaseContext, CommonTruth};
use super::planned_case::PlannedCase;
use super::references::{ReferenceSource, TruthPart, TruthReferences};
use super::scene::SceneContext;
use super::stored_frames::{read_replicates, store_frames};
use crate::inputs::depth_of_field::DepthOfField;
use crate::inputs::input_format::InputFormat;
use crate::run::failure::Failure;
use crate::stats::parts::Groups;

impl SceneContext<'_> {
    /// Measures some cases, and writes each record as soon as it is complete.
    pub(super) fn measure(
        &self,
        missing: &[&PlannedCase],
        frame: &Frame,
        watch: Watch,
    ) -> Result<Vec<Attempt>, Error> {
        if missing.is_empty() {
            return Ok(Vec::new());
        }
        let inputs = self.list_inputs(missing);
        let replicates = read_replicates(self.plan, self.scene)?;
        let stored_frames = store_frames(self.plan, self.scene, &inputs, frame, &replicates)?;
        let depth_of_field = self.prepare_passes(&inputs, frame)?;
        let cropped = frame.cropped();
        let common_alignment = self.plan.common_alignment();
        let has_others = (missing.iter()).any(|case| case.id.alignment != common_alignment);
        let mut common: Option<ColorReference> = None;
        let mut cases = BTreeMap::new();
        // One truth at a time is in memory.
        for alignment in self.common_first() {
            let is_common = alignment == common_alignment;
            let group = missing.iter().copied().enumerate();
            let group = group.filter(|(_, case)| case.id.alignment == alignment);
            let group: Vec<(usize, &PlannedCase)> = group.collect();
            if group.is_empty() && !is_common {
                continue;
            }
            let truth = self.read_truth(alignment)?;
            if group.is_empty() {
                // Only FLIP is measured against it, which needs no ladder and no oracle.
                let viewing = frame.display.into();
                common = Some(Reference::new(&cropped, &truth, None, &viewing)?.into());
                continue;
            }
            let parts = self.truth_parts(alignment, &group, &replicates)?;
            let references = self.references(frame, &truth, &parts)?;
            let context = CaseContext {
                scene: self,
                frame,
                cropped: &cropped,
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
            for (at, planned) in group {
                check_watch(watch, cases.len(), missing.len())?;
                cases.insert(at, self.measure_case(&context, planned)?);
            }
            if is_common && has_others {
                common = Some(references.reference.into());
            }
        }
        Ok(cases.into_values().collect())
    }

    /// Lists the forms of the input that some cases need, in the plan's order.
    fn list_inputs(&self, cases: &[&PlannedCase]) -> Vec<InputFormat> {
        let is_needed = |input: &&InputFormat| cases.iter().any(|case| case.id.input == **input);
        self.plan.inputs.iter().filter(is_needed).copied().collect()
    }

    /// Returns the alignments of the scene's truths; the common one comes first, since its colours
    /// stay in memory.
    fn common_first(&self) -> Vec<Alignment> {
        let mut alignments = self.alignments();
        alignments.sort_by_key(|alignment| *alignment != self.plan.common_alignment());
        alignments
    }

    /// Prepares a truth for measuring, with its own errors as an earlier run left them. All pictures
    /// of a scene are viewed at its frame's exposures.
    fn references<'t>(
        &self,
        frame: &Frame,
        truth: &'t Truth,
        parts: &'t [TruthPart],
    ) -> Result<TruthReferences<'t>, Error> {
        let source = ReferenceSource {
            frame,
            truth,
            parts,
            viewing: frame.display.into(),
        };
        let rungs = self.scene.rungs(self.plan.ladders);
        let path = self.folder().join(errors_file(truth.alignment));
        let key = (self.keys.as_ref()).map(|keys| keys.errors(truth.alignment, parts.len(), rungs));
        if let Some(errors) = key.as_ref().and_then(|key| look_up(&path, key)) {
            return source.with_errors(errors);
        }
        let read_sharp = || Ok(self.read_rung(truth, SHARP)?.rungs.remove(0));
        let rungs = rungs.iter().map(|rung| self.read_rung(truth, *rung));
        let references = source.measure(read_sharp, rungs)?;
        if let Some(key) = key {
            put(&path, key, &[], &references.errors())?;
        }
        Ok(references)
    }

    /// Prepares the pass of depth of field after filters; none if every filter comes last.
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

    /// Measures a case and writes its record. An error that concerns this case alone is its failure.
    fn measure_case(&self, context: &CaseContext, planned: &PlannedCase) -> Result<Attempt, Error> {
        let (case, files) = match context.measure(planned) {
            Ok(measured) => measured,
            Err(error) => return Ok(Attempt::Failed(self.failure(error, planned)?)),
        };
        if let Some(key) = self.case_keys(planned).into_iter().next() {
            put(&self.case_record(planned), key, &files, &case)?;
        }
        Ok(Attempt::Measured(Box::new(case)))
    }

    /// Turns an error of one case into its failure. Returns any other error, which ends the run.
    fn failure(&self, error: Error, planned: &PlannedCase) -> Result<Failure, Error> {
        match &error {
            Error::Filter(
                FilterError::Gpu { .. } | FilterError::Lost { .. } | FilterError::Command { .. },
            )
            | Error::Measure(_) => Ok(Failure {
                scene: planned.id.scene.clone(),
                filter: planned.id.name(),
                alignment: planned.id.alignment,
                reason: error.to_string(),
            }),
            _ => Err(error),
        }
    }

    /// Reads a truth, or renders it.
    pub(super) fn read_truth(&self, alignment: Alignment) -> Result<Truth, Error> {
        self.rendering().truth(alignment)
    }

    /// Renders the missing rungs of a truth's ladder that the plan needs.
    pub(super) fn ensure_ladder(&self, truth: &Truth) -> Result<(), Error> {
        let rungs = (self.scene).needed_rungs(truth.alignment, self.plan.ladders);
        self.rendering().ladder(truth).ensure(rungs)
    }

    /// Reads a rung of a truth's ladder, or renders it.
    fn read_rung(&self, truth: &Truth, subframes: u32) -> Result<Ladder, Error> {
        self.rendering().ladder(truth).read_or_render(subframes)
    }

    /// Makes the parts of the frame, given by its replicates, and of an alignment's truth. Filters'
    /// intervals need them and, with a ladder, so do counts of equivalent sub-frames; otherwise
    /// there are none.
    fn truth_parts(
        &self,
        alignment: Alignment,
        cases: &[(usize, &PlannedCase)],
        frames: &[Picture],
    ) -> Result<Vec<TruthPart>, Error> {
        let has_filters = cases.iter().any(|(_, case)| !case.id.is_reference);
        if !has_filters || !self.plan.measures_parts(self.scene) {
            return Ok(Vec::new());
        }
        let count = self.plan.render.replicates;
        let files = self.rendering().files(alignment);
        let truths = files.replicates(0..count)?;
        let groups = Groups::of(count);
        let without = |group| {
            Ok(TruthPart {
                picture: groups.picture_without(group, frames),
                truth: groups.truth_without(group, &truths)?,
            })
        };
        groups.list().map(without).collect()
    }
}

/// Reports how many cases are measured; ends the work if the caller interrupts it.
fn check_watch(watch: Watch, done: usize, total: usize) -> Result<(), TraceError> {
    let progress = Progress {
        done: done as u64,
        total: total as u64,
    };
    if watch(progress).is_break() {
        Err(TraceError::Cancelled)
    } else {
        Ok(())
    }
}
