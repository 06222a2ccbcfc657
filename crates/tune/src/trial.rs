//! Lines of a tuning's journal: what all trials depend on, then one trial each.

use std::collections::BTreeMap;

use filters::Value;
use measure::named;
use serde::{Deserialize, Serialize};

use crate::target::SceneScores;

named! {
    /// A score that trials are judged by, apart from the others.
    pub enum Objective {
        /// `flip_moving`; always measured.
        Flip = "flip",
        /// `bleed_lateral` of the worst scene.
        Bleed = "bleed",
        /// GPU time.
        Cost = "cost",
    }
}

/// Version of the layout of a journal.
pub const JOURNAL_FORMAT: u32 = 1;

/// Everything that trials depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalHeader {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Filter name.
    pub filter: String,
    /// Preset that tuning started from.
    pub start: String,
    /// The preset's value of every parameter.
    pub values: BTreeMap<String, Value>,
    /// Parameters that may change, each with its range in words.
    pub vary: BTreeMap<String, String>,
    /// Initial points of the search, one coordinate per line of `vary` in the order of the filter's
    /// parameters.
    pub design: Vec<Vec<f64>>,
    /// Scene names in the order in which candidates run on them, each with the content hash of its
    /// truth.
    pub scenes: Vec<(String, String)>,
    /// Measured scores.
    pub objectives: Vec<Objective>,
    /// Upper limit on the cost, as a ratio to the start's.
    pub cost_at_most: Option<f64>,
    /// Upper limit on the lateral bleed of the worst scene, as a ratio to the start's.
    pub bleed_at_most: Option<f64>,
    /// True if clearly worse candidates are dropped.
    pub race: bool,
    /// Seed of the search.
    pub seed: u64,
}

/// One line of the journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Number of the trial, from 0.
    pub trial: usize,
    /// Values of the parameters that may change; all others are as in the journal's first line.
    pub values: BTreeMap<String, Value>,
    /// Outcome of the trial.
    pub outcome: TrialOutcome,
    /// Loss that the search minimises: mean over scenes of log(error / error of the start), plus
    /// penalties.
    pub loss: f64,
    /// Mean without penalties; none if nothing was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// Lateral bleed of the worst scene, in pixels; none if not requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bleed: Option<f64>,
    /// Median GPU time relative to the start's; none if not requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// Scores on each scene that it ran on.
    pub scenes: SceneScores,
}

/// Outcome of a trial.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum TrialOutcome {
    /// It ran on every scene.
    Done,
    /// It was clearly worse than the best after some of the scenes, and did not run on the others.
    Dropped,
    /// It did not run.
    Failed {
        /// Error of the filter.
        reason: String,
    },
}

impl Trial {
    /// Refuses a trial that no tuning with this header could write as its trial `number`, from 0:
    /// the search relies on it.
    pub fn check(&self, header: &JournalHeader, number: usize) -> Result<(), String> {
        if self.trial != number {
            return Err(format!("trial {}, expected {number}", self.trial));
        }
        if !self.values.keys().eq(header.vary.keys()) {
            let names = |names: Vec<String>| {
                if names.is_empty() {
                    "nothing".to_owned()
                } else {
                    names.join(", ")
                }
            };
            return Err(format!(
                "it changes {}, and this tuning {}",
                names(self.values.keys().cloned().collect()),
                names(header.vary.keys().cloned().collect())
            ));
        }
        let known = |scene: &&String| header.scenes.iter().any(|(name, _)| name == *scene);
        if let Some(scene) = self.scenes.keys().find(|scene| !known(scene)) {
            return Err(format!(
                "it ran on {scene}, which is no scene of this tuning"
            ));
        }
        let mut flips = self.scenes.values().map(|score| score.flip);
        if let Some(wrong) = flips.find(|flip| !(0.0..=1.0).contains(flip)) {
            return Err(format!("flip is {wrong}; allowed: 0 to 1"));
        }
        let is_whole = match self.outcome {
            TrialOutcome::Done => self.scenes.len() == header.scenes.len() && self.error.is_some(),
            TrialOutcome::Dropped => number > 0 && !self.scenes.is_empty() && self.error.is_some(),
            TrialOutcome::Failed { .. } => number > 0,
        };
        if is_whole {
            Ok(())
        } else {
            Err(format!(
                "it has {} of {} scenes, and {} error; a trial that is done has all, one that was dropped some, and the \
                 first is done",
                self.scenes.len(),
                header.scenes.len(),
                if self.error.is_some() { "an" } else { "no" }
            ))
        }
    }

    /// Returns true if it ran on every scene.
    pub fn is_done(&self) -> bool {
        self.outcome == TrialOutcome::Done
    }
}
