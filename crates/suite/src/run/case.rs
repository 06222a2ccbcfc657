//! A case: one picture of a scene, with its scores.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use filters::{Convention, Value};
use frame::{FileError, Frame, Truth};
use metrics::{ImageScores, Interval, Jitter, Metric, Scores};
use serde::{Deserialize, Serialize};
use store::RenderFile;
use tracer::{Family, FrameRate, SceneId};

use crate::engine_scene::engine_name;
use crate::identity::CaseId;
use crate::render::ladders::SHARP;

/// Confidence intervals of scores.
pub type Intervals = BTreeMap<Metric, Interval>;

/// One filter preset, or one reference picture, on one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Identity.
    #[serde(flatten)]
    pub id: CaseId,
    /// The scene's family; none of a scene that an engine drew.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<Family>,
    /// Weakness of filters that the scene exposes.
    pub exposes: String,
    /// Engine that drew the frame and the truth; none where both were rendered here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn: Option<Drawn>,
    /// Frame rate that the scene was taken at; none for that of its file, 60 frames per second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<FrameRate>,
    /// Exposure in frames.
    pub exposure: f64,
    /// Every parameter's value.
    pub parameters: BTreeMap<String, Value>,
    /// Width of the pictures that the preset was made for, from which values in pixels were scaled to this run's; none where
    /// the preset names none, or values were left as written.
    #[serde(default)]
    pub reference_width: Option<u32>,
    /// Program and arguments of a filter that is a command, as filter.toml has them. Nothing records what the program does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<Vec<String>>,
    /// Form of velocity, depth and colour, and formats of their textures, that the filter's shaders got; none where that is the
    /// frame's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub convention: Option<Convention>,
    /// Dependence of the filter's weights on colour: the difference between the blur of a mixture and the mixture of the blurs,
    /// relative to what the blur changes; none for reference pictures.
    pub nonlinearity: Option<f64>,
    /// Hash of the truth's inputs: equal hashes mean equal truths.
    pub truth_hash: String,
    /// The measured scores, each with its noise floor.
    pub scores: Scores,
    /// 95 % confidence intervals of the scores; empty where none were asked for.
    #[serde(default, skip_serializing_if = "Intervals::is_empty")]
    pub intervals: Intervals,
    /// Errors over what moves, against the truth of the run's common shutter.
    pub common: ImageScores,
    /// Part of the error that is the filter's noise; none for filters without noise, or where it was not asked for.
    pub jitter: Option<Jitter>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub folder: PathBuf,
}

/// Engine behind a frame and a truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// Engine and version.
    pub engine: String,
    /// Scene of the suite that it drew.
    pub scene: Option<SceneId>,
    /// Number of sub-frames that the truth is the mean of.
    pub subframes: u32,
    /// Distance that 99 % of the moving pixels move at most between two of them, in pixels.
    pub step: f64,
}

impl Drawn {
    /// Says what the truth is: `mean of 32 sub-frames that three.js 0.187.0 drew`.
    pub fn truth_text(&self) -> String {
        format!(
            "mean of {} sub-frames that {} drew",
            self.subframes,
            engine_name(&self.engine)
        )
    }
}

impl Case {
    /// Tells whether it is the reference that is a sharp picture of the shutter's middle, where the frame is not that.
    pub fn is_sharp(&self) -> bool {
        self.is_reference && self.filter == ACCUMULATE && self.preset == SHARP.to_string()
    }

    /// Names a rendered file of its scene; `folder` is that of run.json.
    pub fn render_path(&self, folder: &Path, file: RenderFile) -> PathBuf {
        folder.join(self.scene.folder()).join(file.path())
    }

    /// Reads the frame, without its guard band, and the truth that the case was measured against; `folder` is that of run.json.
    pub fn read_frame_and_truth(&self, folder: &Path) -> Result<(Frame, Truth), FileError> {
        let truth = RenderFile::Truth(self.alignment);
        Ok((
            Frame::read(&self.render_path(folder, RenderFile::Frame))?.cropped(),
            Truth::read(&self.render_path(folder, truth))?,
        ))
    }
}

/// A case is its identity, with scores.
impl Deref for Case {
    type Target = CaseId;

    fn deref(&self) -> &CaseId {
        &self.id
    }
}

/// Name of the reference picture that is the frame itself.
pub const IDENTITY: &str = "identity";
/// Name of the reference picture of [`metrics::scatter_oracle`].
pub const SCATTER_ORACLE: &str = "scatter_oracle";
/// Name of the reference pictures that are means of sub-frames.
pub const ACCUMULATE: &str = "accumulate";
