//! Cases of one scene: read back where their inputs are the same, measured where not.

use std::path::{Path, PathBuf};

use filters::Gpu;
use frame::{Alignment, Frame};
use store::{
    CASE_RECORD, RenderFile, clear_scene, look_up, look_up_alone, put, refuse_scene,
    remove_altered_files, take,
};

use super::pictures::{write_frame, write_truth};
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use super::run_scene::RunScene;
use crate::Error;
use crate::filter_choice::FilterChoice;
use crate::measure::scene_keys::SceneKeys;
use crate::render::files::{find_missing, list_wanted};
use crate::render::frames::render_frame;
use crate::render::replicates::render_shared;
use crate::run::case::Case;
use crate::run::failure::Failure;

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
        let truths = self.plan.alignments().len();
        let forms = self.plan.inputs.len();
        self.scene.check(&self.plan.render, truths, forms)?;
        let frame = self.render(advance)?;
        let missing = (planned.iter().zip(&found)).filter(|(_, found)| found.is_none());
        let missing: Vec<&PlannedCase> = missing.map(|(case, _)| case).collect();
        let label = format!("{} blurs and scores", self.scene.id());
        let monitor = self.plan.monitor;
        let measured = monitor.watch(&label, |watch| {
            self.measure(&missing, &frame, advance, watch)
        })?;
        let mut measured = measured.into_iter();
        let mut cases = Vec::new();
        for found in found {
            cases.push(match found {
                Some(case) => Ok(case),
                None => measured.next().expect("every missing case was tried"),
            });
        }
        Ok((cases, read_back))
    }

    /// Renders the scene's frame and one truth per alignment that a filter of the plan declares, or copies what an engine drew, and
    /// writes their pictures.
    pub(super) fn render(&self, advance: &dyn Fn(u64)) -> Result<Frame, Error> {
        for (record, key) in self.render_records() {
            remove_altered_files(&record, &key);
        }
        self.take_renders()?;
        let folder = self.folder();
        let frame = self.render_first(advance)?;
        let mut files = vec![write_frame(&folder, &frame)?];
        let alignments = self.scene.alignments(self.plan.alignments());
        for (alignment, done) in alignments.into_iter().zip(0..) {
            advance(1 + done * self.truth_steps());
            let truth = self.read_truth(alignment)?;
            self.ensure_ladder(&truth)?;
            files.push(write_truth(&folder, &truth, frame.display)?);
        }
        for ((record, key), files) in self.render_records().into_iter().zip(files) {
            put(&record, key, &files, &())?;
        }
        Ok(frame)
    }

    /// Takes what the plan's folder of truths holds.
    fn take_renders(&self) -> Result<(), Error> {
        let RunPlan {
            render,
            out,
            truths,
            ..
        } = self.plan;
        if let (Some(truths), RunScene::Traced(scene)) = (truths, self.scene) {
            let alignments = self.plan.alignments();
            let files = list_wanted(scene, render, &alignments, self.plan.ladders);
            refuse_scene(&self.folder())?;
            take(&files, truths, out)?;
        }
        Ok(())
    }

    /// Renders the frame, and what its truths have in common; copies the frame that an engine drew.
    fn render_first(&self, advance: &dyn Fn(u64)) -> Result<Frame, Error> {
        let RunPlan {
            render,
            out,
            monitor,
            ..
        } = self.plan;
        let scene = match self.scene {
            RunScene::Traced(scene) => scene,
            RunScene::Drawn(scene) => return scene.copy_frame(&self.folder()),
        };
        let frame = render_frame(scene, render, out, *monitor)?;
        advance(1);
        let alignments = self.plan.alignments();
        let replicates = 0..render.replicates;
        render_shared(scene, render, &alignments, replicates, out, *monitor)?;
        Ok(frame)
    }

    /// Names the folder of the scene's files.
    pub(super) fn folder(&self) -> PathBuf {
        self.scene.folder(&self.plan.out)
    }

    /// Counts the steps of the whole scene, as progress shows them: those of rendering, and the measuring.
    pub fn steps(&self) -> u64 {
        self.render_steps() + 1
    }

    /// Counts a frame and the truths.
    pub(super) fn render_steps(&self) -> u64 {
        1 + self.plan.alignments().len() as u64 * self.truth_steps()
    }

    /// Counts the replicates of a truth, and its ladder.
    fn truth_steps(&self) -> u64 {
        u64::from(self.plan.render.replicates) + 1
    }

    /// Reads a case that was measured before, without its intervals where the plan asks for none. A plan that asks for intervals or ladders
    /// takes no case without them.
    fn read_case(&self, planned: &PlannedCase) -> Option<Case> {
        let record = self.case_record(planned);
        let keys = self.keys_to_read(planned);
        let mut case: Case = keys.iter().find_map(|key| look_up(&record, key))?;
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
        let record = self.case_record(planned);
        let keys = self.keys_to_read(planned);
        let mut found = keys.iter().filter_map(|key| look_up_alone(&record, key));
        found.any(|case: Case| self.is_whole(&case))
    }

    /// Tells whether the frame is to be rendered, and lists the truths that are, by the headers of files.
    pub fn find_missing(&self) -> (bool, Vec<Alignment>) {
        let RunPlan {
            render,
            out,
            truths,
            ..
        } = self.plan;
        let alignments = self.plan.alignments();
        let folders: Vec<&Path> = (truths.iter().chain([out]))
            .map(|folder| &**folder)
            .collect();
        match self.scene {
            // What an engine drew is copied in no time.
            RunScene::Drawn(_) => (false, Vec::new()),
            RunScene::Traced(_) if self.plan.no_cache => (true, alignments),
            RunScene::Traced(scene) => {
                find_missing(scene, render, &alignments, self.plan.ladders, &folders)
            }
        }
    }

    /// Returns the key that a case is recorded by.
    pub(super) fn case_key(&self, planned: &PlannedCase) -> Option<String> {
        self.keys_with(planned, &[self.plan.ladders]).pop()
    }

    /// Lists the keys of cases that the plan may take: where it asks for no ladder, it takes those that have one as well.
    fn keys_to_read(&self, planned: &PlannedCase) -> Vec<String> {
        match self.plan.ladders {
            true => self.keys_with(planned, &[true]),
            false => self.keys_with(planned, &[true, false]),
        }
    }

    /// Returns a key for each answer to whether the case has a ladder; none where nothing is read back.
    fn keys_with(&self, planned: &PlannedCase, ladders: &[bool]) -> Vec<String> {
        let adapter = self.gpu.map(|gpu| &gpu.adapter);
        let (Some(own), Some(keys)) = (planned.inputs(self.plan, adapter), &self.keys) else {
            return Vec::new();
        };
        let alignments = [planned.id.alignment, self.plan.common_alignment()];
        let key = |ladder: &bool| keys.case(&own, alignments, *ladder);
        ladders.iter().map(key).collect()
    }

    pub(super) fn case_record(&self, planned: &PlannedCase) -> PathBuf {
        let folder = self.plan.out.join(planned.id.folder());
        folder.join(CASE_RECORD)
    }

    /// Tells whether frame, truths and their pictures are there and unaltered.
    fn has_its_files(&self) -> bool {
        let mut records = self.render_records().into_iter();
        self.keys.is_some() && records.all(|(record, key)| look_up::<()>(&record, &key).is_some())
    }

    /// Lists the records of the frame and of every truth, in this order, with their keys; none where nothing is read back.
    fn render_records(&self) -> Vec<(PathBuf, String)> {
        let Some(keys) = &self.keys else {
            return Vec::new();
        };
        let folder = self.folder();
        let record = |file: RenderFile| folder.join(file.path().with_extension("json"));
        let mut records = vec![(record(RenderFile::Frame), keys.frame())];
        let alignments = self.scene.alignments(self.plan.alignments());
        records.extend(alignments.into_iter().map(|alignment| {
            let record = record(RenderFile::Truth(alignment));
            (record, keys.truth(alignment))
        }));
        records
    }
}
