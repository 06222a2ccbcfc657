//! Plan of a run.

use std::collections::BTreeMap;
use std::path::PathBuf;

use filters::{AdapterDescription, Layer};
use frame::Alignment;
use scene::Scene;
use tracer::RenderSettings;

use super::part::Part;
use crate::filter_choice::FilterChoice;
use crate::inputs::input_format::InputFormat;
use crate::render::ingested_scene::IngestedScene;
use crate::render::memory::Measured;
use crate::render::rendering::Rendering;
use crate::render::run_scene::RunScene;
use crate::run::case::Case;
use crate::run::sequence::Frames;
use crate::run::{FORMAT, Run};
use crate::stats::parts::{Groups, MIN_REPLICATES};
use crate::{Monitor, PROGRAM};

/// All settings of a run.
pub struct RunPlan {
    /// Loaded scenes.
    pub scenes: Vec<Scene>,
    /// Scenes that engines drew, in the plan's picture size.
    pub ingested: Vec<IngestedScene>,
    /// Loaded filters.
    pub filters: Vec<FilterChoice>,
    /// Forms of the frame that every filter gets.
    pub inputs: Vec<InputFormat>,
    /// Frames of noise for each noisy filter; fewer than 2 leave its noise unmeasured.
    pub jitter_frames: u32,
    /// Consecutive frames of every scene.
    pub frames: Frames,
    /// Settings of frames and truths.
    pub render: RenderSettings,
    /// Noise that the samples of the settings are raised or lowered to; none to leave them.
    pub noise: Option<f64>,
    /// Folder for all files.
    pub out: PathBuf,
    /// True if filters' scores get intervals, which bounds are judged by. Needs a few more
    /// measurements of every picture.
    pub intervals: bool,
    /// True if the ladder of every truth is rendered, for equivalent sub-frames and for the
    /// accumulations among the references. Costs up to the time of the truth. Without it, an
    /// engine's scene has its ladder, and every trailing or leading truth has the one rung that is
    /// the sharp picture of its shutter's middle.
    pub ladders: bool,
    /// True if frames, truths and cases in `out` are removed and made anew.
    pub no_cache: bool,
    /// Shutter alignment that every case is compared with; none for
    /// [`Run::common_alignment`](crate::Run::common_alignment).
    pub common: Option<Alignment>,
    /// Cases to measure; alignments and truths are those of the whole run.
    pub part: Part,
    /// Folder with frames, truths and ladders of earlier renders, laid out like `out`; those with
    /// the same inputs are reused.
    pub truths: Option<PathBuf>,
    /// Listener to progress, which may end the work.
    pub monitor: Monitor,
    /// Gets the cases of each scene as it is finished, of its first frame, from any thread.
    pub finished: fn(&[Case]),
}

/// Nothing to measure: single frames in their full form, with ladders, without intervals and
/// without progress.
impl Default for RunPlan {
    fn default() -> Self {
        Self {
            scenes: Vec::new(),
            ingested: Vec::new(),
            filters: Vec::new(),
            inputs: vec![InputFormat::default()],
            jitter_frames: 0,
            frames: Frames::default(),
            render: RenderSettings::default(),
            noise: None,
            out: "out".into(),
            intervals: false,
            ladders: true,
            no_cache: false,
            common: None,
            part: Part::default(),
            truths: None,
            monitor: Monitor::SILENT,
            finished: |_| {},
        }
    }
}

impl RunPlan {
    /// Returns this plan's run before anything is measured: what all of its cases share.
    pub(crate) fn facts(&self, adapter: Option<&AdapterDescription>) -> Run {
        Run {
            format: FORMAT,
            program: PROGRAM.to_owned(),
            command: Vec::new(),
            adapter: adapter.cloned(),
            render: self.render,
            common_alignment: self.common_alignment(),
            frames: self.frames,
            cases: Vec::new(),
            sequences: Vec::new(),
            failures: Vec::new(),
            overall: Vec::new(),
            read_back: 0,
            seconds: BTreeMap::new(),
        }
    }

    /// Returns the rendering of a scene of the plan.
    pub(crate) fn rendering<'a>(&'a self, scene: RunScene<'a>) -> Rendering<'a> {
        Rendering {
            scene,
            settings: scene.settings(self.render),
            out: &self.out,
            monitor: self.monitor,
        }
    }

    /// Tells whether filters are measured on parts of the frame's replicates, for intervals of
    /// scores or of counts of sub-frames.
    pub(crate) fn measures_parts(&self, scene: RunScene) -> bool {
        let is_needed = self.intervals || self.ladders;
        is_needed && scene.settings(self.render).replicates >= MIN_REPLICATES
    }

    /// Counts what a scene is measured with, against this many truths.
    pub(crate) fn measured(&self, scene: RunScene, truths: usize) -> Measured {
        let parts = if self.measures_parts(scene) {
            Groups::of(self.render.replicates).list().len()
        } else {
            0
        };
        Measured {
            truths,
            forms: self.inputs.len(),
            parts,
        }
    }

    /// Tells whether a filter reads velocities that few filters read.
    pub(crate) fn reads_further_velocities(&self) -> bool {
        let mut filters = self.filters.iter();
        filters.any(|choice| choice.filter.reads_further_velocities())
    }

    /// Tells whether a filter reads the mask of what a blur leaves alone.
    pub(crate) fn reads_exclusion(&self) -> bool {
        let mut filters = self.filters.iter();
        filters.any(|choice| choice.filter.further_inputs().contains(&Layer::Exclusion))
    }

    /// Lists the scenes that are rendered, then those that engines drew.
    pub(crate) fn all_scenes(&self) -> Vec<RunScene<'_>> {
        let traced = self.scenes.iter().map(RunScene::Traced);
        traced
            .chain(self.ingested.iter().map(RunScene::Ingested))
            .collect()
    }

    /// Lists the filters' declared alignments and the common one, each once.
    pub fn alignments(&self) -> Vec<Alignment> {
        let takes_part = |alignment: &Alignment| {
            Some(*alignment) == self.common
                || (self.filters.iter()).any(|choice| choice.filter.alignment == *alignment)
        };
        Alignment::ALL.into_iter().filter(takes_part).collect()
    }

    /// Chooses the alignment that all cases are compared with: the plan's own, or one that filters
    /// declare, so that no truth is rendered just for it.
    pub fn common_alignment(&self) -> Alignment {
        if let Some(common) = self.common {
            return common;
        }
        let declared = self.alignments();
        [Alignment::Centred, Alignment::Trailing]
            .into_iter()
            .find(|alignment| declared.contains(alignment))
            .unwrap_or(Alignment::Leading)
    }
}
