//! A sequence: pictures of consecutive frames of one scene, with scores over time.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::PathBuf;

use metrics::{Metric, SequenceMeasurement, SequenceScores};
use scene::SceneId;
use serde::{Deserialize, Serialize};

use super::case::Intervals;
use crate::identity::{CaseId, FilterId};

/// Upper limit on the frames of a sequence.
pub const MAX_FRAMES: u32 = 1000;

/// The pictures of one filter preset, or of one reference, over all frames of a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Sequence {
    /// Scene.
    pub scene: SceneId,
    /// Filter or reference.
    #[serde(flatten)]
    pub filter: FilterId,
    /// Scores over time.
    pub scores: SequenceScores,
    /// 95 % confidence intervals of the scores; empty if none were requested.
    #[serde(default, skip_serializing_if = "Intervals::is_empty")]
    pub intervals: Intervals,
    /// Worst frame of a score, from 0, for metrics that frames have a share in.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub worst_frames: BTreeMap<Metric, u32>,
    /// Frames, from the first on.
    pub frames: Vec<SequenceFrame>,
}

impl Sequence {
    /// Returns whether it starts with a case.
    pub fn is_of(&self, case: &CaseId) -> bool {
        self.scene == case.scene && self.filter == case.filter_id()
    }
}

/// A sequence is a filter's, with scores.
impl Deref for Sequence {
    type Target = FilterId;

    fn deref(&self) -> &FilterId {
        &self.filter
    }
}

/// Lists the worst frame of each score, from 0, for metrics that frames have a share in.
pub fn worst_frames(measured: &SequenceMeasurement) -> BTreeMap<Metric, u32> {
    let worst = measured.worst_frames.iter();
    worst
        .map(|(metric, frame)| (Metric::Sequence(*metric), *frame as u32))
        .collect()
}

/// One picture of a sequence. Its `case.json` has all scores of the single frame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SequenceFrame {
    /// Folder of the frame's own files, relative to `run.json`: frame and truth.
    pub scene: PathBuf,
    /// Folder of the picture's files, relative to `run.json`.
    pub folder: PathBuf,
    /// Hash of the truth's inputs.
    pub truth_hash: String,
    /// Squared error over what moves; none if nothing does.
    pub error: Option<f64>,
    /// Squared error of the change since the previous frame, along the motion; none for the first
    /// frame.
    pub flicker: Option<f64>,
}

/// Frames of a run, and their display rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frames {
    /// Number of consecutive frames of each scene.
    pub count: u32,
    /// Frames per second at which scenes are shown if at their files' rate. It changes no picture,
    /// and no score but JOD, since times are in frames. Scenes at another frame rate are shown at
    /// that rate.
    pub per_second: f64,
}

impl Default for Frames {
    fn default() -> Self {
        Self {
            count: 1,
            per_second: 60.0,
        }
    }
}

impl Frames {
    /// Returns the frames per second at which a scene is shown: its own frame rate, or the run's
    /// for a scene at its file's rate.
    pub fn shown(&self, scene: &SceneId) -> f64 {
        let rate = scene.rate.unwrap_or_default();
        if rate.per_second == scene::FrameRate::WRITTEN.per_second {
            self.per_second
        } else {
            rate.per_second
        }
    }

    /// Returns whether there is one frame, as in a run without a sequence.
    pub fn is_one(&self) -> bool {
        self.count == 1
    }
}
