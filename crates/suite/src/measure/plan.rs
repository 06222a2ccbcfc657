//! Plan of a run.

use std::path::PathBuf;

use filters::AdapterDescription;
use frame::Alignment;
use tracer::{RenderSettings, Scene};

use super::part::Part;
use super::run_scene::RunScene;
use crate::engine_scene::EngineScene;
use crate::filter_choice::FilterChoice;
use crate::inputs::input_format::InputFormat;
use crate::render::rendering::Rendering;
use crate::run::sequence::Frames;
use crate::run::{FORMAT, Run};
use crate::{Monitor, PROGRAM};

/// Everything that a run is told to do.
pub struct RunPlan {
    /// Loaded scenes.
    pub scenes: Vec<Scene>,
    /// Scenes that engines drew, of the size of the plan's pictures.
    pub engine_scenes: Vec<EngineScene>,
    /// Loaded filters.
    pub filters: Vec<FilterChoice>,
    /// Forms in which every filter gets the frame.
    pub inputs: Vec<InputFormat>,
    /// Frames of noise that a noisy filter is tried with; fewer than 2 leave its noise alone.
    pub jitter_frames: u32,
    /// Consecutive frames that every scene is rendered at.
    pub frames: Frames,
    /// Settings of frames and truths.
    pub render: RenderSettings,
    /// Folder for all files.
    pub out: PathBuf,
    /// True if the scores of filters get intervals, by which bounds are judged. Takes a few more measurements of every picture.
    pub intervals: bool,
    /// True if the ladder of every truth is rendered: for equivalent sub-frames, and for the accumulations among the references. It
    /// takes about as long as half of its truth. What an engine drew has its ladder without that, and every trailing or leading truth
    /// the one rung that is the sharp picture of its shutter's middle.
    pub ladders: bool,
    /// True if frames, truths and cases that lie in `out` are removed and made anew.
    pub no_cache: bool,
    /// Shutter alignment that every case is compared with; none for that of
    /// [`Run::common_alignment`](crate::Run::common_alignment).
    pub common: Option<Alignment>,
    /// Cases that are measured; alignments and truths are those of the whole.
    pub part: Part,
    /// Folder with frames, truths and ladders of earlier renders, by the names of `out`; those of the same inputs are taken from
    /// there.
    pub truths: Option<PathBuf>,
    /// Listener to the progress, which may end the work.
    pub monitor: Monitor,
}

/// Nothing to measure: single frames in their full form, with ladders and without intervals, shown to nobody.
impl Default for RunPlan {
    fn default() -> Self {
        Self {
            scenes: Vec::new(),
            engine_scenes: Vec::new(),
            filters: Vec::new(),
            inputs: vec![InputFormat::default()],
            jitter_frames: 0,
            frames: Frames::default(),
            render: RenderSettings::default(),
            out: "out".into(),
            intervals: false,
            ladders: true,
            no_cache: false,
            common: None,
            part: Part::default(),
            truths: None,
            monitor: Monitor::SILENT,
        }
    }
}

impl RunPlan {
    /// Returns the run of this plan before anything is measured: what all of its cases share.
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
        }
    }

    /// Returns how a scene of the plan is rendered.
    pub(crate) fn rendering<'a>(&'a self, scene: &'a Scene) -> Rendering<'a> {
        Rendering {
            scene,
            settings: self.render,
            out: &self.out,
            monitor: self.monitor,
        }
    }

    /// Tells whether a filter reads velocities that few filters read.
    pub(crate) fn reads_further_velocities(&self) -> bool {
        let mut filters = self.filters.iter();
        filters.any(|choice| !choice.filter.further_inputs().is_empty())
    }

    /// Lists the scenes that are rendered, then those that engines drew.
    pub(crate) fn all_scenes(&self) -> Vec<RunScene<'_>> {
        let traced = self.scenes.iter().map(RunScene::Traced);
        traced
            .chain(self.engine_scenes.iter().map(RunScene::Drawn))
            .collect()
    }

    /// Lists the alignments that filters declare and that of all cases, each once.
    pub fn alignments(&self) -> Vec<Alignment> {
        let takes_part = |alignment: &Alignment| {
            Some(*alignment) == self.common
                || (self.filters.iter()).any(|choice| choice.filter.alignment == *alignment)
        };
        Alignment::ALL.into_iter().filter(takes_part).collect()
    }

    /// Chooses the alignment that all cases are compared with: the plan's own, or one that filters declare, so that no truth is
    /// rendered for it alone.
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
