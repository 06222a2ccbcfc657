//! Scores of one picture of a scene.

use std::collections::BTreeMap;
use std::path::PathBuf;

use filters::Value;
use metrics::{ImageScores, Jitter, Scores};
use serde::{Deserialize, Serialize};
use tracer::Family;

use crate::run::filter_choice::overrides_text;
use crate::{InputFormat, Intervals};

/// One filter preset, or one bar, on one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Scene, with its variant: `sliding_panel@64px_45deg`.
    pub scene: String,
    /// The scene's family.
    pub family: Family,
    /// What the scene exposes.
    pub exposes: String,
    /// Exposure in frames.
    pub exposure: f64,
    /// Filter name; a bar's is `identity`, `scatter_oracle` or `accumulate`.
    pub filter: String,
    /// The preset that the parameters started from; of `accumulate` the number of sub-frames.
    pub preset: String,
    /// Whether this is a bar to measure filters by: no filter, and not held to bounds.
    pub bar: bool,
    /// The form in which the filter got the frame.
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
    /// Program and arguments of a filter that is a command, as filter.toml has them. What the program itself does is
    /// recorded nowhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<Vec<String>>,
    /// How much the filter's weights depend on colour: how far the blur of a mixture is from the mixture of the blurs, relative to
    /// what the blur changes; none for bars.
    pub nonlinearity: Option<f64>,
    /// The shutter alignment that the filter declares and is scored against.
    pub alignment: String,
    /// Hash of the truth's inputs: equal hashes mean equal truths.
    pub truth_hash: String,
    /// The measured scores, each with its noise floor.
    pub scores: Scores,
    /// Where the scores that are bounded lie with a confidence of 95 %; empty where that was not asked for.
    #[serde(default, skip_serializing_if = "Intervals::is_empty")]
    pub intervals: Intervals,
    /// Errors over what moves, against the truth of the run's common shutter.
    pub common: ImageScores,
    /// What of the error is noise; none for filters without any, or where it was not asked for.
    pub jitter: Option<Jitter>,
    /// Folder of the case's pictures, relative to `run.json`.
    pub folder: PathBuf,
}

impl Case {
    /// Names the case as tables and folders do: `jump_flood:paper`, followed by what is not as usual.
    pub fn name(&self) -> String {
        self.name_with(&overrides_text(&self.overrides))
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

/// The bar that doing nothing sets.
pub const IDENTITY: &str = "identity";
/// The bar that [`crate::scatter_oracle`] sets.
pub const SCATTER_ORACLE: &str = "scatter_oracle";
/// The bars that averages of sub-frames set.
pub const ACCUMULATE: &str = "accumulate";
