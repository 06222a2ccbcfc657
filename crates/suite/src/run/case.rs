//! A case: one picture of a scene, with its scores.

use std::collections::BTreeMap;
use std::path::PathBuf;

use filters::{Convention, Value};
use frame::Alignment;
use metrics::{ImageScores, Interval, Jitter, Metric, Scores};
use serde::{Deserialize, Serialize};
use tracer::{Family, FrameRate};

use crate::InputFormat;
use crate::engine_scene::engine_name;
use crate::filter::choice::overrides_text;
use crate::render::ladders::SHARP;

/// Confidence intervals of scores.
pub type Intervals = BTreeMap<Metric, Interval>;

/// One filter preset, or one reference picture, on one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Scene, with its variant and its frame rate: `sliding_panel@64px_45deg`, `fan@144fps`.
    pub scene: String,
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
    /// Filter name; of a reference picture [`IDENTITY`], [`SCATTER_ORACLE`] or [`ACCUMULATE`].
    pub filter: String,
    /// The preset that the parameters started from; of `accumulate` the number of sub-frames.
    pub preset: String,
    /// True for a reference picture that filters are compared with: no filter made it, and no bound limits it.
    #[serde(rename = "bar")]
    pub is_reference: bool,
    /// Form in which the filter got the frame.
    pub input: InputFormat,
    /// Every parameter's value.
    pub parameters: BTreeMap<String, Value>,
    /// Parameters that `--set` gave a value of their own.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub overrides: BTreeMap<String, Value>,
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
    /// The shutter alignment that the filter declares and is scored against.
    pub alignment: Alignment,
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
    pub scene: Option<String>,
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
    /// Names the case as tables and folders do: `jump_flood:paper`, followed by what is not as usual.
    pub fn name(&self) -> String {
        self.name_with(&overrides_text(&self.overrides))
    }

    /// Tells whether it is the reference that is a sharp picture of the shutter's middle, where the frame is not that.
    pub fn is_sharp(&self) -> bool {
        self.is_reference && self.filter == ACCUMULATE && self.preset == SHARP.to_string()
    }

    /// Names the case without its overrides, so that runs with and without them compare.
    pub fn preset_name(&self) -> String {
        self.name_with("")
    }

    fn name_with(&self, overrides: &str) -> String {
        let mut name = match self.preset.as_str() {
            "" => self.filter.clone(),
            preset => format!("{}:{preset}", self.filter),
        };
        name += overrides;
        if let Some(change) = self.input.change() {
            name += &format!(" {change}");
        }
        name
    }
}

/// Name of the reference picture that is the frame itself.
pub const IDENTITY: &str = "identity";
/// Name of the reference picture of [`crate::scatter_oracle`].
pub const SCATTER_ORACLE: &str = "scatter_oracle";
/// Name of the reference pictures that are means of sub-frames.
pub const ACCUMULATE: &str = "accumulate";
