//! One candidate, and what became of it.

use std::collections::BTreeMap;

use filters::Value;
use serde::{Deserialize, Serialize};

use super::SceneScore;

/// One line of the journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// From 0.
    pub trial: usize,
    /// The parameters that may change; all others are as in the journal's first line.
    pub values: BTreeMap<String, Value>,
    /// What became of it.
    pub outcome: TrialOutcome,
    /// What the search was told: mean over scenes of log(error / error of the start), plus penalties; lower is better.
    pub loss: f64,
    /// The same mean without penalties; none where nothing was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// Lateral bleed of the worst scene, in pixels; none where it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bleed: Option<f64>,
    /// GPU time over that of the start, a median; none where it was not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Of each scene that it ran on.
    pub scenes: BTreeMap<String, SceneScore>,
}

/// What became of a candidate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum TrialOutcome {
    /// It ran on every scene.
    Done,
    /// It was clearly worse than the best after some of the scenes, and did not run on the others.
    Dropped,
    /// It did not run.
    Failed {
        /// What the filter had to say.
        reason: String,
    },
}

impl Trial {
    /// Whether it ran on every scene.
    pub fn is_done(&self) -> bool {
        self.outcome == TrialOutcome::Done
    }
}
