//! Evaluation of one candidate, for a search that is driven from outside.

use std::collections::BTreeMap;

use filters::{Settings, Value};
use serde::{Deserialize, Serialize};
use suite::Error;

use crate::evaluator::Evaluator;
use crate::loss::{mean_log_ratio, worst_bleed};
use crate::target::{SceneScore, SceneScores};

/// Scores of one candidate relative to the start, on the same scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Value of every parameter.
    pub values: BTreeMap<String, Value>,
    /// Mean over scenes of log(error / error of the start): below 0 is better.
    pub error: f64,
    /// Lateral bleed of the worst scene, in pixels.
    pub bleed: Option<f64>,
    /// GPU time relative to that of the start.
    pub cost: Option<f64>,
    /// Scores per scene.
    pub scenes: SceneScores,
}

/// Evaluates a candidate on scenes by their indices. Calls `on_score` with each score as soon as it is known; an evaluation that it
/// ends early, by returning false, is an error.
pub fn evaluate_candidate(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    cost: bool,
    on_score: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<Evaluation, Error> {
    let start = evaluator.choice.settings.clone();
    let start = evaluator.score(&start, scenes, |_, _| true)?;
    let scores = evaluator.score(settings, scenes, on_score)?;
    Ok(Evaluation {
        values: settings.values.clone(),
        error: mean_log_ratio(&scores, &start, |_| true)
            .ok_or_else(|| Error::Usage("scenes: none is named; name at least one".to_owned()))?,
        bleed: worst_bleed(&scores),
        cost: match scenes.first() {
            Some(first) if cost => evaluator.measure_cost(settings, *first)?,
            _ => None,
        },
        scenes: scores,
    })
}
