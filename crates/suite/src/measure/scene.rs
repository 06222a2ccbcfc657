//! Cases of one scene: read back where their inputs are the same, measured where not.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use filters::{FilterError, Gpu};
use frame::{Alignment, Frame, Ladder, Truth};
use metrics::Reference;
use tracer::{Progress, Scene, Watch};

use super::case::{CaseContext, CommonTruth};
use super::history::{frames_before, store_frame};
use super::pictures::{write_frame, write_truth};
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::references::TruthReferences;
use super::run_scene::RunScene;
use crate::Error;
use crate::cache::clear::clear_scene;
use crate::cache::record::{
    CASE_RECORD, read_record, read_record_alone, remove_altered_files, write_record,
};
use crate::cache::scene_keys::SceneKeys;
use crate::filter::choice::FilterChoice;
use crate::render::frames::render_frame;
use crate::render::ladders::LadderFiles;
use crate::render::shared::render_shared;
use crate::render::truths::{render_replicates, render_truth};
use crate::run::case::Case;
use crate::run::failure::Failure;
use crate::stats::intervals::truths_without_pairs;

/// One scene of a run.
#[derive(Clone)]
pub(crate) struct SceneContext<'a> {
    pub plan: &'a RunPlan,
    /// The plan's filters, for pictures of its width.
    pub filters: &'a [FilterChoice],
    pub gpu: Option<&'a Gpu>,
    pub scene: RunScene<'a>,
    /// Hashes that records are known by; none where the program cannot be hashed, and nothing is read back.
    pub keys: Option<SceneKeys>,
}

pub(super) type Truths = BTreeMap<Alignment, Truth>;

impl<'a> SceneContext<'a> {
    /// Prepares a scene of a plan for measuring. `program` is the hash of this program; none where it cannot be hashed.
    pub fn new(
        plan: &'a RunPlan,
        filters: &'a [FilterChoice],
        gpu: Option<&'a Gpu>,
        program: Option<&str>,
        scene: RunScene<'a>,
    ) -> Self {
        let alignments = scene.alignments(plan.alignments());
        Self {
            plan,
            filters,
            gpu,
            scene,
            keys: program.map(|program| SceneKeys::new(program, scene, &plan.render, alignments)),
        }
    }
}

impl SceneContext<'_> {
    /// Returns the reference pictures of each alignment, then one case per filter preset and form of the input; a failure where a
    /// filter made no picture that can be measured. Counts the cases that were read back as well. `advance` gets the number of
    /// steps that are done.
    pub fn measure_cases(
        &self,
        advance: &dyn Fn(u64),
    ) -> Result<(Vec<Result<Case, Failure>>, usize), Error> {
        if self.plan.no_cache {
            clear_scene(&self.folder())?;
        }
        let planned = PlannedCase::all(self.plan, self.filters, self.scene);
        let found: Vec<Option<Case>> = planned.iter().map(|case| self.read_case(case)).collect();
        let read_back = found.iter().flatten().count();
        if read_back == found.len() && self.has_its_files() {
            return Ok((found.into_iter().flatten().map(Ok).collect(), read_back));
        }
        self.scene.check(&self.plan.render)?;
        let (frame, truths) = self.render(advance)?;
        let due = (planned.iter().zip(&found)).filter(|(_, found)| found.is_none());
        let due: Vec<&PlannedCase> = due.map(|(case, _)| case).collect();
        let label = format!("{} blurs and scores", self.scene.name());
        let monitor = self.plan.monitor;
        let measured = monitor.watch(&label, |watch| {
            self.measure(&due, &frame, truths, advance, watch)
        })?;
        let mut measured = measured.into_iter();
        let cases = found.into_iter().map(|found| match found {
            Some(case) => Ok(case),
            None => measured.next().expect("every case that is due was tried"),
        });
        Ok((cases.collect(), read_back))
    }

    /// Measures the cases that are due, and writes the record of each as soon as it is whole.
    pub(super) fn measure(
        &self,
        due: &[&PlannedCase],
        frame: &Frame,
        truths: Truths,
        advance: &dyn Fn(u64),
        watch: Watch,
    ) -> Result<Vec<Result<Case, Failure>>, Error> {
        advance(self.render_steps());
        if due.is_empty() {
            return Ok(Vec::new());
        }
        let monitor = self.plan.monitor;
        (monitor.ended)("frame and truths");
        let viewing = frame.display.into();
        let without_pairs = self.truths_without_pairs(due)?;
        let due_at =
            |alignment: Alignment| due.iter().filter(move |case| case.alignment == alignment);
        let common_alignment = self.plan.common_alignment();
        let mut references = BTreeMap::new();
        let mut common_alone = None;
        for (alignment, truth) in &truths {
            if due_at(*alignment).next().is_some() {
                let without = without_pairs.get(alignment).map_or(&[][..], Vec::as_slice);
                let rungs = self.read_rungs(truth);
                let own =
                    TruthReferences::new(frame, truth, rungs, without, &viewing, monitor.ended)?;
                references.insert(*alignment, own);
            } else if *alignment == common_alignment {
                // Only FLIP is measured against it, which needs no ladder and no oracle.
                let frame = frame.cropped();
                common_alone = Some(Reference::new(&frame, truth, None, &viewing)?);
            }
        }
        let own = references.get(&common_alignment);
        let common = match common_alone.as_ref().or(own.map(|own| &own.reference)) {
            Some(reference) => CommonTruth::Other(reference),
            None => CommonTruth::Missing,
        };
        let stored_frames = store_frame(&self.plan.inputs, frame, self.scene.traced())?;
        let frames_before = frames_before(self.plan, self.filters, self.scene)?;
        (monitor.ended)("references");
        let mut cases = Vec::with_capacity(due.len());
        for (done, planned) in due.iter().enumerate() {
            let progress = Progress {
                done: done as u64,
                total: due.len() as u64,
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
                frames_before: &frames_before,
                references: &references[&planned.alignment],
                read_rung: &|subframes| self.read_rung(&truths[&planned.alignment], subframes),
                common: match planned.alignment == common_alignment {
                    true => CommonTruth::Own,
                    false => common,
                },
            };
            cases.push(match context.measure(planned) {
                Ok((case, files)) => {
                    if let Some(key) = self.case_key(planned) {
                        write_record(&self.case_record(planned), key, &files, &case)?;
                    }
                    (monitor.ended)("record");
                    Ok(case)
                }
                Err(error) => Err(self.failure(error, planned)?),
            });
        }
        Ok(cases)
    }

    /// Turns an error that concerns one case into its failure. Any other error ends the run and comes back.
    fn failure(&self, error: Error, planned: &PlannedCase) -> Result<Failure, Error> {
        match &error {
            Error::Filter(FilterError::Gpu { .. } | FilterError::Command { .. })
            | Error::Measure(_) => Ok(Failure {
                scene: self.scene.name().to_owned(),
                filter: planned.name(),
                alignment: planned.alignment.name().to_owned(),
                reason: error.to_string(),
            }),
            _ => Err(error),
        }
    }

    /// Renders the scene's frame and one truth per alignment that a filter of the plan declares, or copies what an engine drew, and
    /// writes their pictures.
    pub(super) fn render(&self, advance: &dyn Fn(u64)) -> Result<(Frame, Truths), Error> {
        for (record, key) in self.render_records() {
            remove_altered_files(&record, &key);
        }
        let folder = self.folder();
        let (frame, truths) = match self.scene {
            RunScene::Traced(scene) => self.trace(scene, advance)?,
            RunScene::Drawn(scene) => {
                let frame = scene.copy_frame(&folder)?;
                let truth = scene.copy_truth(&folder)?;
                (frame, Truths::from([(truth.alignment, truth)]))
            }
        };
        let mut files = vec![write_frame(&folder, &frame)?];
        for truth in truths.values() {
            files.push(write_truth(
                &folder,
                truth,
                self.scene.rungs(),
                frame.display,
            )?);
        }
        for ((record, key), files) in self.render_records().into_iter().zip(files) {
            write_record(&record, key, &files, &())?;
        }
        Ok((frame, truths))
    }

    /// Renders the frame and the truths of a scene.
    fn trace(&self, scene: &Scene, advance: &dyn Fn(u64)) -> Result<(Frame, Truths), Error> {
        let RunPlan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        let frame = render_frame(scene, render, out, *monitor)?;
        let alignments = self.plan.alignments();
        let replicates = 0..render.replicates;
        advance(1);
        render_shared(scene, render, &alignments, replicates, out, *monitor)?;
        let mut truths = Truths::new();
        for (alignment, done) in alignments.into_iter().zip(0..) {
            advance(1 + done * self.truth_steps());
            let truth = render_truth(scene, render, alignment, out, *monitor)?;
            LadderFiles::new(scene, render, &truth, out).ensure(*monitor)?;
            truths.insert(alignment, truth);
        }
        Ok((frame, truths))
    }

    /// Reads the rungs of the ladder of a truth, one after another.
    fn read_rungs(&self, truth: &Truth) -> impl Iterator<Item = Result<Ladder, Error>> {
        let rungs = self.scene.rungs();
        rungs.iter().map(|rung| self.read_rung(truth, *rung))
    }

    /// Reads a rung of the ladder of a truth, or renders it.
    pub fn read_rung(&self, truth: &Truth, subframes: u32) -> Result<Ladder, Error> {
        let RunPlan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        match self.scene {
            RunScene::Traced(scene) => {
                LadderFiles::new(scene, render, truth, out).read_or_render(subframes, *monitor)
            }
            RunScene::Drawn(scene) => scene.read_rung(&self.folder(), subframes),
        }
    }

    /// Names the folder of the scene's files.
    fn folder(&self) -> PathBuf {
        self.scene.folder(&self.plan.out)
    }

    /// Counts the steps of the whole scene, as progress shows them: those of rendering, and the measuring.
    pub fn steps(&self) -> u64 {
        self.render_steps() + 1
    }

    /// Counts a frame and the truths.
    fn render_steps(&self) -> u64 {
        1 + self.plan.alignments().len() as u64 * self.truth_steps()
    }

    /// Counts the replicates of a truth, and its ladder.
    fn truth_steps(&self) -> u64 {
        u64::from(self.plan.render.replicates) + 1
    }

    /// Makes, per alignment of the filters that are due, the truths without one pair of replicates each; none where the plan asks
    /// for no intervals, or an engine drew the truth.
    fn truths_without_pairs(
        &self,
        due: &[&PlannedCase],
    ) -> Result<BTreeMap<Alignment, Vec<Truth>>, Error> {
        let RunPlan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        // Sub-frames are no random samples: those without some of them have holes.
        let RunScene::Traced(scene) = self.scene else {
            return Ok(BTreeMap::new());
        };
        let filters = due.iter().filter(|case| !case.is_reference());
        let alignments: BTreeSet<Alignment> = filters.map(|case| case.alignment).collect();
        (alignments.into_iter())
            .filter(|_| self.plan.intervals)
            .map(|alignment| {
                let replicates = render_replicates(scene, render, alignment, out, *monitor)?;
                Ok((alignment, truths_without_pairs(&replicates)?))
            })
            .collect()
    }

    /// Reads a case that was measured before, without its intervals where the plan asks for none. One that lacks intervals is no
    /// case for a plan that asks for them.
    fn read_case(&self, planned: &PlannedCase) -> Option<Case> {
        let mut case: Case = read_record(&self.case_record(planned), &self.case_key(planned)?)?;
        if !self.plan.intervals {
            case.intervals.clear();
        }
        self.is_whole(&case).then_some(case)
    }

    /// Tells whether a case that was read has the intervals that the plan asks for.
    fn is_whole(&self, case: &Case) -> bool {
        case.is_reference
            || case.drawn.is_some()
            || !self.plan.intervals
            || !case.intervals.is_empty()
    }

    /// Tells whether a case was measured before, without looking at its pictures.
    pub fn has_record(&self, planned: &PlannedCase) -> bool {
        let Some(key) = self.case_key(planned) else {
            return false;
        };
        let case = read_record_alone::<Case>(&self.case_record(planned), &key);
        case.is_some_and(|case| self.is_whole(&case))
    }

    /// Tells whether the frame is missing, and each truth, without looking at their pictures.
    pub fn find_missing(&self) -> (bool, Vec<bool>) {
        let records = self.render_records();
        let is_missing =
            |(record, key): &(PathBuf, String)| read_record_alone::<()>(record, key).is_none();
        match records.split_first() {
            None => (true, vec![true; self.plan.alignments().len()]),
            Some((frame, truths)) => (is_missing(frame), truths.iter().map(is_missing).collect()),
        }
    }

    fn case_key(&self, planned: &PlannedCase) -> Option<String> {
        let adapter = self.gpu.map(|gpu| &gpu.adapter);
        let own = planned.inputs(self.plan, adapter)?;
        let keys = self.keys.as_ref()?;
        Some(keys.case(&own, planned.alignment, self.plan.common_alignment()))
    }

    fn case_record(&self, planned: &PlannedCase) -> PathBuf {
        let folder = self.plan.out.join(planned.folder(self.scene));
        folder.join(CASE_RECORD)
    }

    /// Tells whether frame, truths and their pictures are there and unaltered.
    fn has_its_files(&self) -> bool {
        let mut records = self.render_records().into_iter();
        self.keys.is_some()
            && records.all(|(record, key)| read_record::<()>(&record, &key).is_some())
    }

    /// Lists the records of the frame and of every truth, in this order, with their keys; none where nothing is read back.
    fn render_records(&self) -> Vec<(PathBuf, String)> {
        let Some(keys) = &self.keys else {
            return Vec::new();
        };
        let folder = self.folder();
        let mut records = vec![(folder.join("frame.json"), keys.frame())];
        let alignments = self.scene.alignments(self.plan.alignments());
        records.extend(alignments.into_iter().map(|alignment| {
            let record = folder.join(format!("truth_{alignment}.json"));
            (record, keys.truth(alignment))
        }));
        records
    }
}
