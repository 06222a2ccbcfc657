//! Evaluation of one candidate, for a search that is driven from outside.

use std::collections::BTreeMap;

use filters::{Settings, Value};
use serde::{Deserialize, Serialize};
use suite::Error;

use crate::cost::Stopwatch;
use crate::evaluator::Evaluator;
use crate::loss::{mean_log_ratio, worst_bleed};
use crate::target::SceneScore;

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
    pub scenes: BTreeMap<String, SceneScore>,
}

/// Evaluates a candidate on scenes by their indices; `on_score` as in [`Evaluator::score_candidate`]. An evaluation that
/// `on_score` ends early is an error.
pub fn evaluate_candidate(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    cost: bool,
    on_score: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<Evaluation, Error> {
    let start = evaluator.choice.settings.clone();
    let start = score_by_name(evaluator, &start, scenes, |_, _| true)?;
    let scores = score_by_name(evaluator, settings, scenes, on_score)?;
    if scores.len() < scenes.len() {
        return Err(tracer::TraceError::Cancelled.into());
    }
    let stopwatch = match (evaluator.gpu, scenes) {
        (Some(gpu), [first, ..]) if cost => Some(Stopwatch {
            gpu,
            choice: &evaluator.choice,
            frame: &evaluator.targets[*first].scene.frame,
        }),
        _ => None,
    };
    Ok(Evaluation {
        values: settings.values.clone(),
        error: mean_log_ratio(&scores, &start, |_| true)
            .ok_or_else(|| Error::Usage("scenes: none is named; name at least one".to_owned()))?,
        bleed: worst_bleed(&scores),
        cost: (stopwatch.map(|own| own.measure_ratio(settings))).transpose()?,
        scenes: scores,
    })
}

fn score_by_name(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    on_score: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<BTreeMap<String, SceneScore>, Error> {
    let scores = evaluator.score_candidate(settings, scenes, on_score)?;
    let names = scenes
        .iter()
        .map(|scene| &evaluator.targets[*scene].scene.name);
    Ok(names.cloned().zip(scores).collect())
}
