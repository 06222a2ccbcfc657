//! A case: one picture of a scene, with its scores.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use scene::{Family, FrameRate};

use crate::{RenderFile, SHARP};
use filters::{Convention, Value};
use frame::{FileError, Frame, Truth};
use metrics::{ImageScores, Interval, Jitter, Metric, Scores, Smear};
use serde::{Deserialize, Serialize};

use crate::identity::{CaseId, ReferencePicture};
use crate::render::ingested_scene::Drawn;

/// Confidence intervals of scores.
pub type Intervals = BTreeMap<Metric, Interval>;

/// One filter preset, or one reference picture, on one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Identity.
    #[serde(flatten)]
    pub id: CaseId,
    /// The scene's family; none for a scene that an engine drew.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<Family>,
    /// Weakness of filters that the scene exposes.
    pub exposes: String,
    /// Engine that drew the frame and the truth; none if both were rendered here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn: Option<Drawn>,
    /// Frame rate of the scene; none for its file's, 60 frames per second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<FrameRate>,
    /// Exposure in frames.
    pub exposure: f64,
    /// Every parameter's value.
    pub parameters: BTreeMap<String, Value>,
    /// Picture width that the preset was made for, from which values in pixels were scaled to this
    /// run's; none if the preset names none, or values were left as written.
    #[serde(default)]
    pub reference_width: Option<u32>,
    /// Program and arguments of a filter that is a command, as in filter.toml. Nothing records what
    /// the program does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<Vec<String>>,
    /// Form of velocity, depth and colour, and texture formats, that the filter's shaders got; none
    /// if the frame's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub convention: Option<Convention>,
    /// Dependence of the filter's weights on colour: the difference between the blur of a mixture
    /// and the mixture of the blurs, relative to the blur's change; none for reference pictures.
    pub nonlinearity: Option<f64>,
    /// Hash of the truth's inputs: equal hashes mean equal truths.
    pub truth_hash: String,
    /// The measured scores, each with its noise floor.
    pub scores: Scores,
    /// 95 % confidence intervals of the scores; empty if none were requested.
    #[serde(default, skip_serializing_if = "Intervals::is_empty")]
    pub intervals: Intervals,
    /// Errors over what moves, against the truth of the run's common shutter.
    pub common: ImageScores,
    /// The filter's noise as a part of the error; none for filters without noise, or if not
    /// requested.
    pub jitter: Option<Jitter>,
    /// Smear of the only object that moves; none for reference pictures, and if there is no such
    /// object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smear: Option<Smear>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub folder: PathBuf,
}

impl Case {
    /// Returns whether this is the reference that shows the shutter's middle sharply, if the frame
    /// does not.
    pub fn is_sharp(&self) -> bool {
        self.reference() == Some(ReferencePicture::Accumulation(SHARP))
    }

    /// Names a rendered file of its scene; `folder` is run.json's.
    pub fn render_path(&self, folder: &Path, file: RenderFile) -> PathBuf {
        folder.join(self.scene.folder()).join(file.path())
    }

    /// Reads the frame, without its guard band, and the case's truth; `folder` is run.json's.
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
