//! Cases of one scene: read back if their inputs are the same, otherwise measured.

use std::path::{Path, PathBuf};

use crate::files::render_file::take;
use crate::{
    CASE_RECORD, Error, RenderFile, clear_scene, look_up, put, refuse_scene, remove_altered_files,
};
use filters::Gpu;
use frame::{Alignment, Frame};

use super::attempt::Attempt;
use super::pictures::{PARTS_FILE, write_frame, write_truth};
use super::plan::RunPlan;
use super::planned_case::PlannedCase;
use crate::measuring::scene_keys::SceneKeys;
use crate::render::rendering::Rendering;
use crate::render::run_scene::RunScene;
use crate::run::case::Case;
use crate::run::failure::Failure;

/// One scene of a run.
#[derive(Clone)]
pub(crate) struct SceneContext<'a> {
    pub plan: &'a RunPlan,
    pub gpu: Option<&'a Gpu>,
    pub scene: RunScene<'a>,
    /// Hashes that identify records; none if the program cannot be hashed, and then nothing is read
    /// back.
    pub keys: Option<SceneKeys>,
}

impl<'a> SceneContext<'a> {
    /// Prepares a scene of a plan for measuring. `program` is the hash of this program; none if it
    /// cannot be hashed.
    pub fn new(
        plan: &'a RunPlan,
        gpu: Option<&'a Gpu>,
        program: Option<&str>,
        scene: RunScene<'a>,
    ) -> Self {
        let alignments = scene.alignments(plan.alignments());
        Self {
            plan,
            gpu,
            scene,
            keys: program.map(|program| {
                let settings = scene.settings(plan.render);
                SceneKeys::new(program, scene, &settings, alignments)
            }),
        }
    }
}

/// Cases of a scene, in the order of the plan.
pub struct SceneCases {
    /// Cases with scores.
    pub cases: Vec<Case>,
    /// Cases whose filter made no measurable picture.
    pub failures: Vec<Failure>,
    /// How many of the cases were read back.
    pub read_back: usize,
}

impl SceneContext<'_> {
    /// Measures each alignment's reference pictures, then one case per filter preset and input form.
    /// `advance` gets the number of finished steps.
    pub fn measure_cases(&self, advance: &dyn Fn(u64)) -> Result<SceneCases, Error> {
        if self.plan.no_cache {
            clear_scene(&self.folder())?;
        }
        let planned = PlannedCase::all(self.plan, self.scene);
        let stored_cases: Vec<Option<Case>> = (planned.iter())
            .map(|case| self.read_case(case, look_up))
            .collect();
        let read_back = stored_cases.iter().flatten().count();
        if read_back == stored_cases.len() && self.has_its_files() {
            return Ok(SceneCases {
                cases: stored_cases.into_iter().flatten().collect(),
                failures: Vec::new(),
                read_back,
            });
        }
        let truths = self.plan.alignments().len();
        (self.scene).check(&self.plan.render, self.plan.measured(self.scene, truths))?;
        let frame = self.render(advance)?;
        let missing = (planned.iter().zip(&stored_cases)).filter(|(_, stored)| stored.is_none());
        let missing: Vec<&PlannedCase> = missing.map(|(case, _)| case).collect();
        let label = format!("{} blurs and scores", self.scene.id());
        let monitor = self.plan.monitor;
        advance(self.plan.render_steps());
        let measured = monitor.watch(&label, |watch| self.measure(&missing, &frame, watch))?;
        let mut measured = measured.into_iter();
        let (mut cases, mut failures) = (Vec::new(), Vec::new());
        for stored in stored_cases {
            let attempt = match stored {
                Some(case) => Attempt::Measured(Box::new(case)),
                None => measured.next().expect("every missing case was tried"),
            };
            match attempt {
                Attempt::Measured(case) => cases.push(*case),
                Attempt::Failed(failure) => failures.push(failure),
            }
        }
        Ok(SceneCases {
            cases,
            failures,
            read_back,
        })
    }

    /// Renders the scene's frame and one truth per alignment that a filter of the plan declares,
    /// and writes their pictures. Finished files are copied instead.
    fn render(&self, advance: &dyn Fn(u64)) -> Result<Frame, Error> {
        for (record, key) in self.render_records() {
            remove_altered_files(&record, &key);
        }
        self.take_renders()?;
        let folder = self.folder();
        let frame = self.render_first(advance)?;
        let mut files = vec![write_frame(&folder, &frame)?];
        for (alignment, done) in self.alignments().into_iter().zip(0..) {
            advance(1 + done * self.plan.truth_steps());
            let truth = self.read_truth(alignment)?;
            self.ensure_ladder(&truth)?;
            files.push(write_truth(&folder, &truth, frame.display)?);
        }
        for ((record, key), files) in self.render_records().into_iter().zip(files) {
            put(&record, key, &files, &())?;
        }
        Ok(frame)
    }

    /// Copies finished files from the folder that has them: the plan's truths, or an ingested one.
    fn take_renders(&self) -> Result<(), Error> {
        let Some(source) = self.scene.source(self.plan.truths.as_deref()) else {
            return Ok(());
        };
        let files = (self.rendering()).list_wanted(&self.alignments(), self.plan.ladders);
        refuse_scene(&self.folder())?;
        Ok(take(&files, &source, &self.folder())?)
    }

    /// Renders the frame, and what its truths share.
    fn render_first(&self, advance: &dyn Fn(u64)) -> Result<Frame, Error> {
        let rendering = self.rendering();
        let frame = rendering.frame()?;
        advance(1);
        rendering.shared(&self.alignments(), 0..rendering.settings.replicates)?;
        Ok(frame)
    }

    /// Returns the rendering of the scene.
    pub(super) fn rendering(&self) -> Rendering<'_> {
        self.plan.rendering(self.scene)
    }

    /// Lists the alignments of the scene's truths.
    pub(super) fn alignments(&self) -> Vec<Alignment> {
        self.scene.alignments(self.plan.alignments())
    }

    /// Names the folder of the scene's files.
    pub(super) fn folder(&self) -> PathBuf {
        self.plan.out.join(self.scene.id().folder())
    }

    /// Reads a case that was measured before, without its intervals if the plan asks for none. A
    /// plan that asks for intervals or ladders accepts no case without them. `look_up` may check
    /// its pictures as well.
    pub fn read_case(
        &self,
        planned: &PlannedCase,
        look_up: fn(&Path, &str) -> Option<Case>,
    ) -> Option<Case> {
        let record = self.case_record(planned);
        let keys = self.case_keys(planned);
        let mut case = keys.iter().find_map(|key| look_up(&record, key))?;
        if !self.plan.intervals {
            case.intervals.clear();
            return Some(case);
        }
        let has_none = case.is_reference || !self.plan.measures_parts(self.scene);
        (has_none || self.has_intervals(&case)).then_some(case)
    }

    /// Returns whether a case has intervals, and the pictures that a sequence's intervals are
    /// measured from.
    fn has_intervals(&self, case: &Case) -> bool {
        let parts = self.plan.out.join(&case.folder).join(PARTS_FILE);
        !case.intervals.is_empty() && (self.plan.frames.is_one() || parts.is_file())
    }

    /// Lists the frame and the truths that must be rendered, by the headers of files.
    pub fn find_missing(&self) -> Vec<RenderFile> {
        let plan = self.plan;
        let source = self.scene.source(plan.truths.as_deref());
        let is_there = |_: &PathBuf| !plan.no_cache || self.scene.ingested().is_some();
        let folders: Vec<PathBuf> = (source.into_iter().chain([self.folder()]))
            .filter(is_there)
            .collect();
        (self.rendering()).find_missing(&self.alignments(), plan.ladders, &folders)
    }

    /// Lists the keys of cases that the plan accepts, first the one for its own records: a plan
    /// without ladders also accepts cases with them. None if nothing is read back.
    pub(super) fn case_keys(&self, planned: &PlannedCase) -> Vec<String> {
        let adapter = self.gpu.map(|gpu| &gpu.adapter);
        let (Some(inputs), Some(keys)) = (planned.inputs(self.plan, adapter), &self.keys) else {
            return Vec::new();
        };
        let alignments = [planned.id.alignment, self.plan.common_alignment()];
        let ladders: &[bool] = if self.plan.ladders {
            &[true]
        } else {
            &[false, true]
        };
        let key = |has_ladder: &bool| keys.case(&inputs, alignments, *has_ladder);
        ladders.iter().map(key).collect()
    }

    pub(super) fn case_record(&self, planned: &PlannedCase) -> PathBuf {
        let folder = self.plan.out.join(planned.id.folder());
        folder.join(CASE_RECORD)
    }

    /// Returns whether frame, truths and their pictures are there and unaltered.
    fn has_its_files(&self) -> bool {
        let mut records = self.render_records().into_iter();
        self.keys.is_some() && records.all(|(record, key)| look_up::<()>(&record, &key).is_some())
    }

    /// Lists the records of the frame and of every truth, in this order, with their keys; none if
    /// nothing is read back.
    fn render_records(&self) -> Vec<(PathBuf, String)> {
        let Some(keys) = &self.keys else {
            return Vec::new();
        };
        let folder = self.folder();
        let record = |file: RenderFile| folder.join(file.path().with_extension("json"));
        let mut records = vec![(record(RenderFile::Frame), keys.frame())];
        records.extend(self.alignments().into_iter().map(|alignment| {
            let record = record(RenderFile::Truth(alignment));
            (record, keys.truth(alignment))
        }));
        records
    }
}
