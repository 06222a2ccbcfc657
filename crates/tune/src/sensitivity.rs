//! Sensitivity analysis: finds parameters that could be constants.

use std::collections::BTreeMap;

use filters::Value;
use measure::Error;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use tracer::{Progress, Watch};

use crate::evaluator::Evaluator;
use crate::loss::{FAILED, mean_log_ratio};
use crate::sobol::{SobolIndices, sobol_indices};
use crate::space::Space;

/// An axis may become a constant if its total index, including its interval, is below this: it
/// causes less than a fiftieth of the variance.
const CONSTANT_TOTAL: f64 = 0.02;
/// Points of a slice along an axis.
const SLICE: usize = 9;

/// Effect of each parameter on the error: `sensitivity.json`. The error is the mean over scenes of
/// log(FLIP / FLIP of the start).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Number of scored candidates.
    pub candidates: usize,
    /// Number of candidates that did not run; they count as very bad.
    pub failed: usize,
    /// Results by parameter.
    pub parameters: BTreeMap<String, ParameterSensitivity>,
}

/// Effect of one parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterSensitivity {
    /// Shares of the error's variance.
    #[serde(deserialize_with = "read_indices")]
    pub indices: SobolIndices,
    /// True if the parameter may become a constant.
    pub constant: bool,
    /// The error along the parameter's range, all others at the start.
    pub slice: Vec<(Value, f64)>,
}

/// Refuses files of versions that could write elementary effects and no indices.
fn read_indices<'de, D: Deserializer<'de>>(deserializer: D) -> Result<SobolIndices, D::Error> {
    Option::deserialize(deserializer)?.ok_or_else(|| {
        D::Error::custom("a parameter has no Sobol indices: an older version made this study by Morris screening alone")
    })
}

/// Counts the candidates of a study of all axes of a space.
pub fn count_candidates(space: &Space, rows: usize) -> usize {
    let axes = space.axes.len();
    let slices = (0..axes).map(|axis| slice_points(space, axis).len());
    rows * (axes + 2) + slices.sum::<usize>()
}

/// Lists the points along an axis with its values there, all others at the start: fewer than
/// [`SLICE`] if some round to one value.
fn slice_points(space: &Space, axis: usize) -> Vec<(Value, Vec<f64>)> {
    let points = (0..SLICE).map(|step| {
        let mut point = space.point(&space.start);
        point[axis] = step as f64 / (SLICE - 1) as f64;
        let value = space.settings(&point).values[&space.axes[axis].name].clone();
        (value, point)
    });
    let mut points: Vec<(Value, Vec<f64>)> = points.collect();
    points.dedup_by(|(value, _), (before, _)| value == before);
    points
}

/// Scores candidates all over the space, `rows` x (axes + 2) for Sobol indices and some more for
/// slices along each axis. Reports each to `watch`.
pub fn analyze_sensitivity(
    evaluator: &mut Evaluator,
    space: &Space,
    rows: usize,
    seed: u64,
    watch: Watch,
) -> Result<Sensitivity, Error> {
    let all = evaluator.all_scenes();
    let start = evaluator.score(&space.start, &all, |_, _| true)?;
    let axes = space.axes.len();
    let planned = count_candidates(space, rows);
    let (mut candidates, mut failed) = (0, 0);
    let interrupted = evaluator.monitor.interrupted;
    let mut error = |point: &[f64]| -> Result<f64, Error> {
        Progress::report(watch, candidates, planned)?;
        candidates += 1;
        match evaluator.score(&space.settings(point), &all, |_, _| !interrupted()) {
            Ok(scores) => Ok(mean_log_ratio(&scores, &start, |_| true).expect("there are scenes")),
            Err(error) if error.is_interruption() => Err(error),
            Err(_) => {
                failed += 1;
                Ok(FAILED)
            }
        }
    };
    let indices = sobol_indices(axes, rows, seed, &mut error)?;
    let mut parameters = BTreeMap::new();
    for (index, (axis, indices)) in space.axes.iter().zip(indices).enumerate() {
        let points = slice_points(space, index).into_iter();
        let slice = points.map(|(value, point)| Ok((value, error(&point)?)));
        let parameter = ParameterSensitivity {
            indices,
            constant: indices.total.high < CONSTANT_TOTAL,
            slice: slice.collect::<Result<_, Error>>()?,
        };
        parameters.insert(axis.name.clone(), parameter);
    }
    Ok(Sensitivity {
        candidates,
        failed,
        parameters,
    })
}
