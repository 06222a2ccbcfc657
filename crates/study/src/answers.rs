//! The file of answers that the page writes.

use frame::Alignment;
use serde::{Deserialize, Serialize};
use tracer::SceneId;

use crate::question::Question;
use crate::study::Study;

/// Version of the layout of a file of answers.
pub const ANSWERS_FORMAT: u32 = 1;
/// Upper limit on the bytes of a file of answers.
pub const MAX_ANSWER_BYTES: u64 = 1 << 24;

/// Name of the truth in a file of answers.
pub const TRUTH_CLIP: &str = "[truth]";
/// Name of the sharp frame in a file of answers.
pub const SHARP_CLIP: &str = "[sharp frame]";

/// Answers of one session. The file holds nothing about the person.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnswerFile {
    /// [`ANSWERS_FORMAT`].
    pub format: u32,
    /// Program and version that made the page.
    pub program: String,
    /// The study.
    pub study: Study,
    /// The question of this session.
    pub question: Question,
    /// Seed of the order of pairs and of the sides.
    pub seed: u64,
    /// The display as the browser described it when the file was saved.
    pub display: DisplayFacts,
    /// Answers in the order in which they were given.
    pub answers: Vec<Answer>,
}

/// A display as a browser describes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisplayFacts {
    /// Pixels of the display per pixel of style sheets.
    pub device_pixel_ratio: f64,
    /// Width and height of the page's window, in pixels of style sheets.
    pub viewport: [f64; 2],
}

/// One answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// Scene.
    pub scene: SceneId,
    /// Alignment of the shutter.
    pub alignment: Alignment,
    /// Filter on the left, [`TRUTH_CLIP`] or [`SHARP_CLIP`].
    pub left: String,
    /// Filter on the right, [`TRUTH_CLIP`] or [`SHARP_CLIP`].
    pub right: String,
    /// What was chosen.
    pub choice: Chosen,
    /// Time from the first picture to the answer, in milliseconds.
    pub milliseconds: f64,
    /// Pixels of the display per pixel of the picture, along one side.
    pub zoom: u32,
}

/// A choice between two clips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Chosen {
    /// The clip on the left.
    Left,
    /// The clip on the right.
    Right,
    /// Neither: no difference.
    Neither,
}
