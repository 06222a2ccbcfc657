//! Jackknife intervals of scores, from the truth's replicates, left out two by two.

use std::collections::BTreeMap;

use frame::{Replicate, Truth, TruthError};
use metrics::{Interval, Measured, Metric, Scores, jackknife};

/// Intervals of scores by the names of their metrics.
pub type Intervals = BTreeMap<String, Interval>;

/// Replicates that are left out together: one of either half, so that the halves stay equally large.
const GROUP: usize = 2;

/// The fewest replicates that have an interval: two groups.
pub const FEWEST_REPLICATES: u32 = 4;

/// The truths that all of `replicates` but one pair each make. Replicates share one support, so that the pixels that scores are
/// pooled over stay the same.
pub fn truths_without_pairs(replicates: &[Replicate]) -> Result<Vec<Truth>, TruthError> {
    (0..replicates.len() / GROUP)
        .map(|pair| {
            let kept = (replicates.iter().enumerate()).filter(|(at, _)| at / GROUP != pair);
            let kept: Vec<Replicate> = (kept.map(|(_, replicate)| replicate).zip(0..))
                .map(|(replicate, index)| Replicate {
                    index,
                    ..replicate.clone()
                })
                .collect();
            Truth::of(&kept)
        })
        .collect()
}

/// The intervals of those of `metrics` that have a score against the whole truth and against the truth without each of its
/// pairs: [`jackknife`].
///
/// A percentile is no smooth function of the truth, and its jackknife is too narrow: its interval is wider by the score's
/// floor at either end.
pub fn intervals(
    whole: &Scores,
    without: &[Scores],
    metrics: impl IntoIterator<Item = Metric>,
) -> Intervals {
    (metrics.into_iter())
        .filter_map(|metric| {
            let Measured::Score(score) = whole.get(metric) else {
                return None;
            };
            let value = |scores: &Scores| match scores.get(metric) {
                Measured::Score(score) => Some(score.value),
                Measured::NotApplicable { .. } => None,
            };
            let without: Option<Vec<f64>> = without.iter().map(value).collect();
            let mut interval = jackknife(score.value, &without?)?;
            if metric.row().is_percentile {
                interval.low -= score.floor;
                interval.high += score.floor;
            }
            Some((metric.name(), interval))
        })
        .collect()
}
