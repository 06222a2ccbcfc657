//! Sensitivity analysis: parameters that could as well be constants.

use std::collections::BTreeMap;

use filters::Value;
use serde::{Deserialize, Serialize};
use tracer::{Progress, TraceError, Watch};

use super::loss::{FAILED, mean_log_ratio};
use super::morris::{ElementaryEffects, morris};
use super::sobol::{SobolIndices, sobol_indices};
use super::{Evaluator, Space};
use crate::Error;

/// An axis whose total index is below this, its interval included, may become a constant: it causes less than a fiftieth of
/// the variance.
const CONSTANT_TOTAL: f64 = 0.02;
/// The same by screening alone: its range changes the error by less than so much in the log, which is one percent.
const CONSTANT_EFFECT: f64 = 0.01;
/// Points of a slice along an axis.
const SLICE: usize = 9;

/// How much work goes into a study.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Trajectories of the screening; 0 for none.
    pub trajectories: usize,
    /// Rows behind Sobol indices; 0 for none.
    pub rows: usize,
}

/// What each parameter does to the error: `sensitivity.json`. The error is the mean over scenes of log(FLIP / FLIP of the
/// start).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// How many candidates were scored.
    pub candidates: usize,
    /// How many of them did not run; they count as very bad.
    pub failed: usize,
    /// Trajectories of the screening; 0 where there was none.
    #[serde(default)]
    pub trajectories: usize,
    /// By parameter.
    pub parameters: BTreeMap<String, ParameterSensitivity>,
}

/// What one parameter does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterSensitivity {
    /// By screening.
    pub effects: Option<ElementaryEffects>,
    /// By variance.
    pub indices: Option<SobolIndices>,
    /// Whether it may become a constant.
    pub constant: bool,
    /// The error along its range, all others at the start.
    pub slice: Vec<(Value, f64)>,
}

impl ParameterSensitivity {
    /// How much it matters beside the others of the same study.
    pub fn importance(&self) -> f64 {
        match (self.indices, self.effects) {
            (Some(indices), _) => indices.total.value,
            (None, Some(effects)) => effects.mean_size,
            (None, None) => 0.0,
        }
    }
}

impl Effort {
    /// How many candidates are scored, the slices among them.
    fn candidates(self, axes: usize) -> usize {
        self.trajectories * (axes + 1) + self.rows * (axes + 2) + axes * SLICE
    }
}

/// Scores many candidates all over the space; `watch` hears of each.
pub fn sensitivity(
    evaluator: &mut Evaluator,
    space: &Space,
    effort: Effort,
    seed: u64,
    watch: Watch,
) -> Result<Sensitivity, Error> {
    if effort == Effort::default() || effort.trajectories == 1 || effort.rows == 1 {
        return Err(Error::Usage(
            "--morris and --sobol: allowed is 2 or more; one walk has no spread".to_owned(),
        ));
    }
    let all: Vec<usize> = (0..evaluator.targets.len()).collect();
    let names: Vec<String> = (evaluator.targets.iter())
        .map(|target| target.shot.name.clone())
        .collect();
    let start = evaluator.scores(&space.start, &all, |_, _| true)?;
    let start: BTreeMap<_, _> = names.iter().cloned().zip(start).collect();
    let (mut candidates, mut failed) = (0, 0);
    let interrupted = evaluator.monitor.interrupted;
    let mut error = |point: &[f64]| -> Result<f64, Error> {
        let progress = Progress {
            done: candidates as u64,
            total: effort.candidates(space.axes.len()) as u64,
        };
        if watch(progress).is_break() {
            return Err(TraceError::Cancelled.into());
        }
        candidates += 1;
        match evaluator.scores(&space.settings(point), &all, |_, _| !interrupted()) {
            Ok(scores) if scores.len() == all.len() => {
                let scores = names.iter().cloned().zip(scores).collect();
                Ok(mean_log_ratio(&scores, &start, |_| true).expect("there are scenes"))
            }
            Ok(_) => Err(TraceError::Cancelled.into()),
            Err(error) if error.is_interruption() => Err(error),
            Err(_) => {
                failed += 1;
                Ok(FAILED)
            }
        }
    };
    let axes = space.axes.len();
    let effects = match effort.trajectories {
        0 => None,
        trajectories => Some(morris(axes, trajectories, seed, &mut error)?),
    };
    let indices = match effort.rows {
        0 => None,
        rows => Some(sobol_indices(axes, rows, seed, &mut error)?),
    };
    let mut parameters = BTreeMap::new();
    for (index, axis) in space.axes.iter().enumerate() {
        let mut slice: Vec<(Value, f64)> = Vec::new();
        for step in 0..SLICE {
            let mut point = space.point(&space.start);
            point[index] = step as f64 / (SLICE - 1) as f64;
            let value = space.settings(&point).values[&axis.name].clone();
            if slice.last().is_none_or(|(last, _)| *last != value) {
                slice.push((value, error(&point)?));
            }
        }
        let effects = effects.as_ref().map(|effects| effects[index]);
        let indices = indices.as_ref().map(|indices| indices[index]);
        let constant = match (indices, effects) {
            (Some(indices), _) => indices.total.high < CONSTANT_TOTAL,
            (None, Some(effects)) => effects.mean_size < CONSTANT_EFFECT,
            (None, None) => false,
        };
        let found = ParameterSensitivity {
            effects,
            indices,
            constant,
            slice,
        };
        parameters.insert(axis.name.clone(), found);
    }
    Ok(Sensitivity {
        candidates,
        failed,
        trajectories: effort.trajectories,
        parameters,
    })
}
