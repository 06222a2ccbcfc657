//! All cases of one scene: those whose inputs are what they were are read back, the others measured.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use filters::Gpu;
use frame::{Alignment, Frame, Ladder, Picture, Truth};
use metrics::{MeasureError, Reference};
use tracer::{Progress, Scene, Watch};

use crate::case::Case;
use crate::folder::forget::forget;
use crate::render::memory::check_measuring_memory;
use crate::render::rendered::{
    frame_of, frame_settings, replicates_of, scene_folder, truth_and_ladder_of,
};
use crate::render::scatter_oracle::oracle_of;
use crate::run::failure::Failure;
use crate::run::filter_choice::FilterChoice;
use crate::run::inputs::SceneInputs;
use crate::run::kept::{discard_altered, keep, read_record, recall};
use crate::run::pictures::{write_frame, write_truth};
use crate::run::subject::Subject;
use crate::run::workbench::Workbench;
use crate::run::{Plan, viewing};
use crate::{Error, InputFormat, truths_without_pairs};

/// One scene of a run.
pub(crate) struct SceneRun<'a> {
    pub plan: &'a Plan,
    /// The plan's filters, for pictures of its width.
    pub filters: &'a [FilterChoice],
    pub gpu: Option<&'a Gpu>,
    pub scene: &'a Scene,
    /// The alignment that every case is compared with.
    pub common: Alignment,
    /// What is kept is known by these; none where nothing can be kept.
    pub inputs: Option<SceneInputs>,
}

/// Steps that progress shows for measuring the cases of a scene.
const MEASURING_STEPS: u64 = 12;

/// Beside a case's pictures.
pub(crate) const CASE_RECORD: &str = "case.json";

type Truths = BTreeMap<Alignment, (Truth, Ladder)>;

impl SceneRun<'_> {
    /// Per alignment the bars, then one case per filter preset and form of the input; a failure where one made no picture that
    /// can be measured. Then the number of cases that were read back.
    pub fn cases(
        &self,
        advance: &dyn Fn(u64),
    ) -> Result<(Vec<Result<Case, Failure>>, usize), Error> {
        if self.plan.no_cache {
            forget(&scene_folder(&self.plan.out, self.scene))?;
        }
        let subjects = Subject::all(self.plan, self.filters);
        let kept: Vec<Option<Case>> = subjects.iter().map(|subject| self.kept(subject)).collect();
        let read_back = kept.iter().flatten().count();
        if read_back == kept.len() && self.has_its_files() {
            return Ok((kept.into_iter().flatten().map(Ok).collect(), read_back));
        }
        frame_settings(self.scene, &self.plan.render).check(self.scene)?;
        check_measuring_memory(self.scene, &self.plan.render)?;
        let (frame, truths) = self.render(advance)?;
        let due = (subjects.iter().zip(&kept)).filter(|(_, kept)| kept.is_none());
        let due: Vec<&Subject> = due.map(|(subject, _)| subject).collect();
        let label = format!("{} blurs and scores", self.scene.name);
        let made = self.plan.monitor.watch(&label, |watch| {
            self.measured(&due, &frame, &truths, advance, watch)
        })?;
        let mut made = made.into_iter();
        let cases = kept.into_iter().map(|kept| match kept {
            Some(case) => Ok(case),
            None => made.next().expect("every case that is due was tried"),
        });
        Ok((cases.collect(), read_back))
    }

    /// Measures some of the cases, each of which is kept as soon as it is whole.
    fn measured(
        &self,
        due: &[&Subject],
        frame: &Frame,
        truths: &Truths,
        advance: &dyn Fn(u64),
        watch: Watch,
    ) -> Result<Vec<Result<Case, Failure>>, Error> {
        if due.is_empty() {
            return Ok(Vec::new());
        }
        let cropped = frame.cropped();
        let judged: BTreeSet<Alignment> = due.iter().map(|subject| subject.alignment).collect();
        let oracles: BTreeMap<Alignment, Picture> = (truths.iter())
            .filter(|(alignment, _)| judged.contains(alignment))
            .map(|(alignment, (truth, _))| (*alignment, oracle_of(frame, truth)))
            .collect();
        let references = (truths.iter())
            .filter(|(alignment, _)| judged.contains(alignment) || **alignment == self.common)
            .map(|(alignment, (truth, ladder))| {
                let viewing = viewing(self.scene);
                let reference = Reference::new(&cropped, truth, Some(ladder), &viewing)?;
                let reference = match oracles.get(alignment) {
                    Some(oracle) => reference.with_best(oracle)?,
                    // Only FLIP is measured against it.
                    None => reference,
                };
                Ok((*alignment, reference))
            })
            .collect::<Result<BTreeMap<_, _>, Error>>()?;
        let parts = self.parts(due)?;
        let without = (parts.iter())
            .map(|(alignment, parts)| {
                let ladder = Some(&truths[alignment].1);
                let viewing = viewing(self.scene);
                let reference = |part| {
                    Reference::new(&cropped, part, ladder, &viewing)?.with_best(&oracles[alignment])
                };
                let references: Result<_, MeasureError> = parts.iter().map(reference).collect();
                Ok((*alignment, references?))
            })
            .collect::<Result<BTreeMap<_, Vec<Reference>>, Error>>()?;
        let stored: Vec<(InputFormat, Frame)> = (self.plan.inputs.iter())
            .map(|format| (*format, format.of(frame)))
            .collect();
        let mut cases = Vec::with_capacity(due.len());
        for (done, subject) in due.iter().enumerate() {
            let progress = Progress {
                done: done as u64,
                total: due.len() as u64,
            };
            if watch(progress).is_break() {
                return Err(tracer::TraceError::Cancelled.into());
            }
            advance(self.render_steps() + MEASURING_STEPS * done as u64 / due.len() as u64);
            let alignment = subject.alignment;
            let (truth, ladder) = &truths[&alignment];
            let workbench = Workbench {
                plan: self.plan,
                gpu: self.gpu,
                scene: self.scene,
                frame,
                stored: &stored,
                truth,
                ladder,
                reference: &references[&alignment],
                oracle: &oracles[&alignment],
                common: (alignment != self.common).then(|| &references[&self.common]),
                without: without.get(&alignment).map(Vec::as_slice),
            };
            cases.push(match workbench.case(subject) {
                Ok((case, files)) => {
                    if let Some(inputs) = self.inputs_of(subject) {
                        keep(&self.record(subject), inputs, &files, &case)?;
                    }
                    Ok(case)
                }
                Err(error) => Err(Failure::of(error, subject, self.scene)?),
            });
        }
        Ok(cases)
    }

    /// The scene's frame and one truth per alignment that a filter of the plan declares, with their pictures.
    fn render(&self, advance: &dyn Fn(u64)) -> Result<(Frame, Truths), Error> {
        let Plan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        for (record, inputs) in self.records() {
            discard_altered(&record, &inputs);
        }
        let folder = scene_folder(out, self.scene);
        let frame = frame_of(self.scene, render, out, *monitor)?;
        let mut files = vec![write_frame(&folder, self.scene, &frame)?];
        let mut truths = Truths::new();
        for (alignment, done) in self.plan.alignments().into_iter().zip(0..) {
            advance(1 + done * self.truth_steps());
            let made = truth_and_ladder_of(self.scene, render, alignment, out, *monitor)?;
            files.push(write_truth(&folder, self.scene, &made.0)?);
            truths.insert(alignment, made);
        }
        for ((record, inputs), files) in self.records().into_iter().zip(files) {
            keep(&record, inputs, &files, &())?;
        }
        Ok((frame, truths))
    }

    /// Counts the steps of the whole scene, as progress shows them: those of rendering, each of which is watched, and those of
    /// measuring.
    pub fn steps(&self) -> u64 {
        self.render_steps() + MEASURING_STEPS
    }

    /// Counts a frame and the truths.
    fn render_steps(&self) -> u64 {
        1 + self.plan.alignments().len() as u64 * self.truth_steps()
    }

    /// Counts the replicates of a truth, and its ladder.
    fn truth_steps(&self) -> u64 {
        u64::from(self.plan.render.replicates) + 1
    }

    /// Tells whether a case was measured before, without looking at its pictures.
    pub fn has_record(&self, subject: &Subject) -> bool {
        let Some(inputs) = self.inputs_of(subject) else {
            return false;
        };
        let case = read_record::<Case>(&self.record(subject), &inputs);
        case.is_some_and(|case| self.is_whole(&case))
    }

    /// Tells whether the frame is missing, and counts missing truths, without looking at their pictures.
    pub fn count_missing(&self) -> (bool, usize) {
        let records = self.records();
        let missing =
            |(record, inputs): &(PathBuf, String)| read_record::<()>(record, inputs).is_none();
        match records.split_first() {
            None => (true, self.plan.alignments().len()),
            Some((frame, truths)) => (
                missing(frame),
                truths.iter().filter(|truth| missing(truth)).count(),
            ),
        }
    }

    /// Tells whether a kept case has the intervals that the plan asks for.
    fn is_whole(&self, case: &Case) -> bool {
        case.bar || !self.plan.intervals || !case.intervals.is_empty()
    }

    /// Per alignment that filters are judged by, the truths that all replicates but a pair each make.
    fn parts(&self, due: &[&Subject]) -> Result<BTreeMap<Alignment, Vec<Truth>>, Error> {
        let Plan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        let filters = due.iter().filter(|subject| !subject.is_bar());
        let judged: BTreeSet<Alignment> = filters.map(|subject| subject.alignment).collect();
        (judged.into_iter())
            .filter(|_| self.plan.intervals)
            .map(|alignment| {
                let replicates = replicates_of(self.scene, render, alignment, out, *monitor)?;
                Ok((alignment, truths_without_pairs(&replicates)?))
            })
            .collect()
    }

    /// A case that was measured before: with intervals where the plan asks for some, without them otherwise.
    fn kept(&self, subject: &Subject) -> Option<Case> {
        let mut case: Case = recall(&self.record(subject), &self.inputs_of(subject)?)?;
        if !self.plan.intervals {
            case.intervals.clear();
        }
        self.is_whole(&case).then_some(case)
    }

    fn inputs_of(&self, subject: &Subject) -> Option<String> {
        let adapter = self.gpu.map(|gpu| &gpu.adapter);
        let own = subject.inputs(self.plan, adapter)?;
        let inputs = self.inputs.as_ref()?;
        Some(inputs.case(&own, subject.alignment, self.common))
    }

    fn record(&self, subject: &Subject) -> PathBuf {
        let folder = self.plan.out.join(subject.folder(self.scene));
        folder.join(CASE_RECORD)
    }

    /// Whether frame, truths and their pictures are there as they were written.
    fn has_its_files(&self) -> bool {
        let mut records = self.records().into_iter();
        self.inputs.is_some()
            && records.all(|(record, inputs)| recall::<()>(&record, &inputs).is_some())
    }

    /// The records of the frame and of every truth, in this order, with their inputs; none where nothing can be kept.
    fn records(&self) -> Vec<(PathBuf, String)> {
        let Some(inputs) = &self.inputs else {
            return Vec::new();
        };
        let folder = scene_folder(&self.plan.out, self.scene);
        let mut records = vec![(folder.join("frame.json"), inputs.frame())];
        records.extend(self.plan.alignments().into_iter().map(|alignment| {
            let record = folder.join(format!("truth_{alignment}.json"));
            (record, inputs.truth(alignment))
        }));
        records
    }
}
