//! Scores of a candidate, for a search that is driven from outside.

use std::collections::BTreeMap;

use filters::{Settings, Value};
use serde::{Deserialize, Serialize};

use super::cost::Stopwatch;
use super::loss::{mean_log_ratio, worst_bleed};
use super::{Evaluator, SceneScore};
use crate::Error;

/// Scores of one candidate beside the start, on the same scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Every parameter.
    pub values: BTreeMap<String, Value>,
    /// Mean over scenes of log(error / error of the start): below 0 is better.
    pub error: f64,
    /// Lateral bleed of the worst scene, in pixels.
    pub bleed: Option<f64>,
    /// GPU time over that of the start.
    pub cost: Option<f64>,
    /// Per scene.
    pub scenes: BTreeMap<String, SceneScore>,
}

/// Scores a candidate on scenes by their indices; `heard` as in [`Evaluator::scores`]. Refuses to sum up what was ended
/// early.
pub fn answer(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    cost: bool,
    heard: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<Answer, Error> {
    let start = evaluator.choice.settings.clone();
    let start = named(evaluator, &start, scenes, |_, _| true)?;
    let scores = named(evaluator, settings, scenes, heard)?;
    if scores.len() < scenes.len() {
        return Err(tracer::TraceError::Cancelled.into());
    }
    let stopwatch = match (evaluator.gpu, scenes) {
        (Some(gpu), [first, ..]) if cost => Some(Stopwatch {
            gpu,
            choice: &evaluator.choice,
            frame: &evaluator.targets[*first].shot.frame,
        }),
        _ => None,
    };
    Ok(Answer {
        values: settings.values.clone(),
        error: mean_log_ratio(&scores, &start, |_| true)
            .ok_or_else(|| Error::Usage("scenes: none is named; name at least one".to_owned()))?,
        bleed: worst_bleed(&scores),
        cost: stopwatch.map(|it| it.ratio(settings)).transpose()?,
        scenes: scores,
    })
}

fn named(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    heard: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<BTreeMap<String, SceneScore>, Error> {
    let scores = evaluator.scores(settings, scenes, heard)?;
    let names = scenes
        .iter()
        .map(|scene| &evaluator.targets[*scene].shot.name);
    Ok(names.cloned().zip(scores).collect())
}
