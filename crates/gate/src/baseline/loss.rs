//! Loss of a score on one scene since the baseline.

use measure::Case;
use metrics::{Measured, Metric};
use scene::SceneId;
use serde::Serialize;

use crate::baseline::Baseline;
use crate::baseline::accept::round_score;

/// Loss of a score on one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneLoss {
    pub scene: SceneId,
    /// Amount by which the score is worse, in the metric's unit; negative is better.
    pub worse: f64,
    /// Upper limit on the error of that amount by the truth's noise; 0 if the score is the
    /// baseline's.
    pub noise: f64,
}

impl SceneLoss {
    pub(super) fn certainly_exceeds(&self, margin: f64) -> bool {
        self.worse - self.noise > margin
    }

    pub(super) fn may_exceed(&self, margin: f64) -> bool {
        self.worse + self.noise > margin
    }
}

/// Refuses a case that was measured against another truth.
pub(super) fn check_truth(case: &Case, baseline: &Baseline) -> Result<(), String> {
    let truths = baseline.truths.get(&case.scene);
    match truths.and_then(|truths| truths.get(&case.alignment)) {
        Some(hash) if *hash == case.truth_hash => Ok(()),
        Some(_) => Err(format!(
            "its truth of {} ({}) is another: scene, size, samples, seed or tracer have changed; measure with the settings of \
             the baseline, or accept a run with the new truth: shuttertruth limits accept",
            case.scene, case.alignment
        )),
        None => Err(format!(
            "knows no truth of {} ({}); accept a run with it: shuttertruth limits accept",
            case.scene, case.alignment
        )),
    }
}

/// Returns how much worse a case is than in the baseline; none if the metric did not apply then.
pub(super) fn find_loss(
    case: &Case,
    metric: Metric,
    baseline: &Baseline,
) -> Result<Option<SceneLoss>, String> {
    let filters = baseline.scores.get(&case.scene);
    let Some(scores) = filters.and_then(|filters| {
        // A parameter with an overridden value is judged by its preset.
        (filters.get(&case.name())).or_else(|| filters.get(&case.of_preset().name()))
    }) else {
        return Err(format!(
            "has no scores of {} on {}; accept a run with them: shuttertruth limits accept",
            case.name(),
            case.scene
        ));
    };
    let badness = |value: f64| metric.ideal().badness(value);
    match (scores.get(&metric), case.scores.get(metric)) {
        (Some(old), Measured::Score(new)) => Ok(Some(SceneLoss {
            scene: case.scene.clone(),
            worse: badness(new.value) - badness(*old),
            noise: if round_score(new.value) == *old {
                0.0
            } else {
                // One truth's noise is in both scores, and most of it cancels. Both half widths
                // together are an upper limit; the baseline has none, so its half width is taken to
                // be the same.
                let interval = case.interval(metric);
                interval.map_or(new.floor, |interval| interval.high - interval.low)
            },
        })),
        (Some(old), Measured::NotApplicable { reason }) => Err(format!(
            "{metric} of {} on {} was {old} and does not apply any more: {reason}",
            case.name(),
            case.scene
        )),
        (None, _) => Ok(None),
    }
}
