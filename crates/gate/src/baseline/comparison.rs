//! Comparison of a run with a baseline.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use measure::{Case, Error, ONE_SIDED, Run, SceneMean, plain_mean};
use metrics::Metric;
use serde::Serialize;

use crate::baseline::Baseline;
use crate::baseline::loss::{SceneLoss, check_truth, find_loss};
use judge::Decision;
use judge::Margin;
use judge::settling_samples;

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
    /// Amount by which the score is worse than the baseline's, mean over scenes, in the metric's
    /// unit; negative is better.
    pub worse: f64,
    /// One-sided 95 % confidence limits of that mean, the lower and the upper one.
    #[serde(rename = "bounds")]
    pub interval: [f64; 2],
    /// Amount by which it may be worse, as a mean and on every scene.
    pub margin: f64,
    /// Uncertainty that decided.
    pub decided_by: DecidedBy,
    /// Scenes that are certainly worse by more than the margin; if inconclusive, those that may be.
    pub losses: Vec<SceneLoss>,
    /// Samples per pixel that would settle an inconclusive comparison.
    pub settled_by: Option<u64>,
}

/// Uncertainty that a verdict depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DecidedBy {
    /// Scatter over the scenes: the interval of the mean.
    Scenes,
    /// The truth's noise on single scenes.
    Noise,
}

/// Verdict on a filter since the baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparisonKind {
    /// No scene exceeds the margin, or the interval of the mean does not.
    NoWorse,
    /// A scene certainly exceeds the margin, or the whole interval of the mean does.
    Worse,
    /// The truth's noise leaves both open.
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

/// Compares every case of a run with the baseline, scene by scene against the same truth, per
/// filter and per metric with a margin. A certain loss on one scene decides, however many others
/// are as good as before. `path` is the baseline's file, for messages.
pub fn compare_with_baseline(
    run: &Run,
    baseline: &Baseline,
    margins: &BTreeMap<Metric, Margin>,
    path: &Path,
) -> Result<Vec<BaselineComparison>, Error> {
    let refuse = |reason: String| Error::Refused(format!("{}: {reason}", path.display()));
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
            let measured = cases.iter().filter(|case| case.name() == *filter);
            let losses = measured.filter_map(|case| find_loss(case, *metric, baseline).transpose());
            let losses = losses.collect::<Result<Vec<SceneLoss>, _>>();
            let losses = losses.map_err(refuse)?;
            if !losses.is_empty() {
                let samples = run.render.samples_per_pixel;
                let comparison = compare_losses(filter, *metric, losses, margin.width, samples);
                comparisons.push(comparison);
            }
        }
    }
    if comparisons.is_empty() {
        Err(refuse(
            "no score with a margin applies to any scene, and there is nothing to compare"
                .to_owned(),
        ))
    } else {
        Ok(comparisons)
    }
}

fn compare_losses(
    filter: &str,
    metric: Metric,
    losses: Vec<SceneLoss>,
    margin: f64,
    samples_per_pixel: u32,
) -> BaselineComparison {
    let worse: Vec<f64> = losses.iter().map(|loss| loss.worse).collect();
    let mean = plain_mean(&worse, ONE_SIDED);
    let (kind, decided_by) = decide(&mean, &losses, margin);
    let listed = |loss: &SceneLoss| match kind {
        ComparisonKind::NoWorse => false,
        ComparisonKind::Worse => loss.certainly_exceeds(margin),
        ComparisonKind::Inconclusive => loss.may_exceed(margin),
    };
    let losses: Vec<SceneLoss> = losses.into_iter().filter(listed).collect();
    let settling = losses.iter().map(|loss| {
        let apart = (loss.worse - margin).abs();
        settling_samples(samples_per_pixel, loss.noise, apart)
    });
    BaselineComparison {
        kind,
        filter: filter.to_owned(),
        metric,
        scenes: mean.scenes,
        worse: mean.mean,
        interval: mean.interval,
        margin,
        decided_by,
        settled_by: settling
            .max()
            .filter(|_| kind == ComparisonKind::Inconclusive),
        losses,
    }
}

/// Decides by single scenes if the truth's noise allows it, otherwise by the mean. More samples
/// settle what stays open.
fn decide(mean: &SceneMean, losses: &[SceneLoss], margin: f64) -> (ComparisonKind, DecidedBy) {
    let [low, high] = mean.interval;
    if losses.iter().any(|loss| loss.certainly_exceeds(margin)) {
        (ComparisonKind::Worse, DecidedBy::Noise)
    } else if !losses.iter().any(|loss| loss.may_exceed(margin)) {
        (ComparisonKind::NoWorse, DecidedBy::Noise)
    } else if mean.scenes > 1 && low > margin {
        // The interval of one scene has no width.
        (ComparisonKind::Worse, DecidedBy::Scenes)
    } else if high <= margin {
        (ComparisonKind::NoWorse, DecidedBy::Scenes)
    } else {
        (ComparisonKind::Inconclusive, DecidedBy::Noise)
    }
}

#[cfg(test)]
mod tests {
    use scene::SceneId;

    use super::*;

    const MARGIN: f64 = 0.1;

    /// Compares a score on as many scenes as there are pairs of a loss and its noise.
    fn compare(losses: &[(f64, f64)]) -> BaselineComparison {
        let losses = (losses.iter().enumerate()).map(|(index, &(worse, noise))| SceneLoss {
            scene: SceneId::new(format!("scene_{index}"), None),
            worse,
            noise,
        });
        compare_losses("own:default", Metric::FLIP, losses.collect(), MARGIN, 64)
    }

    /// Names the scenes whose losses are listed.
    fn listed(comparison: &BaselineComparison) -> Vec<String> {
        let scenes = comparison.losses.iter().map(|loss| loss.scene.to_string());
        scenes.collect()
    }

    #[test]
    fn a_certain_loss_on_one_scene_is_a_failure_among_any_number_of_others() {
        for others in [0, 1, 4, 25] {
            let mut losses = vec![(0.0, 0.0); others];
            losses.push((0.3, 0.15));
            let comparison = compare(&losses);
            assert_eq!(comparison.kind, ComparisonKind::Worse, "{others} others");
            assert_eq!(comparison.decided_by, DecidedBy::Noise);
            assert_eq!(listed(&comparison), [format!("scene_{others}")]);
            assert_eq!(comparison.settled_by, None);
        }
    }

    #[test]
    fn a_score_that_improved_on_one_scene_is_no_worse_however_the_scenes_scatter() {
        let comparison = compare(&[(-5.0, 0.2), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]);
        assert!(comparison.interval[1] > MARGIN, "{comparison:?}");
        assert_eq!(comparison.kind, ComparisonKind::NoWorse);
        assert!(comparison.losses.is_empty());
    }

    #[test]
    fn a_loss_within_the_noise_is_open_and_names_the_samples_that_settle_it() {
        // The noise is 3 times the distance from the margin: 16 times the samples make a quarter of
        // it.
        for others in [0, 3] {
            let mut losses = vec![(0.0, 0.0); others];
            losses.push((0.3, 0.6));
            let comparison = compare(&losses);
            assert_eq!(
                comparison.kind,
                ComparisonKind::Inconclusive,
                "{others} others"
            );
            assert_eq!(comparison.decided_by, DecidedBy::Noise);
            assert_eq!(listed(&comparison), [format!("scene_{others}")]);
            assert_eq!(comparison.settled_by, Some(1024));
        }
    }

    #[test]
    fn scenes_that_are_all_worse_within_their_noise_are_worse_together() {
        let losses = [0.2, 0.22, 0.19, 0.21, 0.2].map(|worse| (worse, 0.3));
        let comparison = compare(&losses);
        assert_eq!(comparison.kind, ComparisonKind::Worse);
        assert_eq!(comparison.decided_by, DecidedBy::Scenes);
        // One such scene alone proves nothing.
        assert_eq!(compare(&losses[..1]).kind, ComparisonKind::Inconclusive);
        // Among many that are as good as before, the mean is within the margin.
        let mut many = vec![(0.0, 0.0); 20];
        many.extend(&losses[..1]);
        let comparison = compare(&many);
        assert_eq!(comparison.kind, ComparisonKind::NoWorse);
        assert_eq!(comparison.decided_by, DecidedBy::Scenes);
    }
}
