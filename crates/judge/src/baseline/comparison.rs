//! Comparison of a run with a baseline.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use metrics::{Measured, Metric};
use serde::Serialize;
use suite::{Case, Error, ONE_SIDED, Run, plain_mean};

use crate::baseline::Baseline;
use crate::bounds::Margin;
use crate::outcome::Decision;

/// Change of one metric of one filter since the baseline, over all scenes that it applies to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BaselineComparison {
    /// Verdict.
    pub kind: ComparisonKind,
    /// `jump_flood:paper`.
    pub filter: String,
    /// Metric of the score.
    pub metric: Metric,
    /// Number of compared scenes.
    pub scenes: usize,
    /// Amount by which the score is worse than the baseline's, mean over scenes, in the metric's unit; negative is better.
    pub worse: f64,
    /// One-sided 95 % confidence limits of that mean, the lower and the upper one.
    #[serde(rename = "bounds")]
    pub interval: [f64; 2],
    /// Amount by which it may be worse.
    pub margin: f64,
}

/// Verdict on a filter since the baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparisonKind {
    /// The interval does not exceed the margin.
    NoWorse,
    /// The whole interval exceeds the margin.
    Worse,
    /// The interval contains the margin.
    Inconclusive,
}

impl ComparisonKind {
    /// Returns its words for a report.
    pub fn label(self) -> &'static str {
        match self {
            Self::NoWorse => "no worse",
            Self::Worse => "WORSE",
            Self::Inconclusive => "INCONCLUSIVE",
        }
    }
}

impl BaselineComparison {
    /// Returns the decision that follows from this comparison alone.
    pub fn decision(&self) -> Decision {
        match self.kind {
            ComparisonKind::NoWorse => Decision::Pass,
            ComparisonKind::Worse => Decision::Broken,
            ComparisonKind::Inconclusive => Decision::Inconclusive,
        }
    }
}

/// Compares every case of a run with the baseline, scene by scene against the same truth, per filter and per metric with a margin. Any
/// number of scenes decides, and the interval of one scene has no width. `path` is the baseline's file, for messages.
pub fn compare_with_baseline(
    run: &Run,
    baseline: &Baseline,
    margins: &BTreeMap<Metric, Margin>,
    path: &Path,
) -> Result<Vec<BaselineComparison>, Error> {
    let refuse = |reason: String| Error::Usage(format!("{}: {reason}", path.display()));
    if margins.is_empty() {
        return Err(refuse(
            "nothing says by how much a score may be worse; give bounds.toml beside the scenes a table [margin], with lines \
             such as flip_moving = 0.005"
                .to_owned(),
        ));
    }
    let cases: Vec<&Case> = run.cases.iter().filter(|case| !case.is_reference).collect();
    for case in &cases {
        check_truth(case, baseline).map_err(refuse)?;
    }
    let names: BTreeSet<String> = cases.iter().map(|case| case.name()).collect();
    let mut comparisons = Vec::new();
    for filter in &names {
        for (metric, margin) in margins {
            let own = cases.iter().filter(|case| case.name() == *filter);
            let differences =
                own.filter_map(|case| difference(case, *metric, baseline).transpose());
            let differences = differences
                .collect::<Result<Vec<f64>, _>>()
                .map_err(refuse)?;
            if !differences.is_empty() {
                comparisons.push(compare_scores(filter, *metric, &differences, margin.width));
            }
        }
    }
    match comparisons.is_empty() {
        true => Err(refuse(
            "no score with a margin applies to any scene, and there is nothing to compare"
                .to_owned(),
        )),
        false => Ok(comparisons),
    }
}

fn compare_scores(
    filter: &str,
    metric: Metric,
    differences: &[f64],
    margin: f64,
) -> BaselineComparison {
    let found = plain_mean(differences, ONE_SIDED);
    let [low, high] = found.interval;
    let kind = if high <= margin {
        ComparisonKind::NoWorse
    } else if low > margin {
        ComparisonKind::Worse
    } else {
        ComparisonKind::Inconclusive
    };
    BaselineComparison {
        kind,
        filter: filter.to_owned(),
        metric,
        scenes: found.scenes,
        worse: found.mean,
        interval: found.interval,
        margin,
    }
}

/// Refuses a case that was measured against another truth.
fn check_truth(case: &Case, baseline: &Baseline) -> Result<(), String> {
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
fn difference(case: &Case, metric: Metric, baseline: &Baseline) -> Result<Option<f64>, String> {
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
        (Some(old), Measured::Score(new)) => Ok(Some(badness(new.value) - badness(*old))),
        (Some(old), Measured::NotApplicable { reason }) => Err(format!(
            "{metric} of {} on {} was {old} and does not apply any more: {reason}",
            case.name(),
            case.scene
        )),
        (None, _) => Ok(None),
    }
}
