//! Jackknife intervals of scores, from truths without one pair of replicates each.

use frame::{Replicate, Truth, TruthError};
use metrics::{Measured, Metric, Scores, jackknife};

use crate::run::case::Intervals;

/// Replicates that are left out together: one of either half, so that the halves stay equally large.
const GROUP: usize = 2;

/// Least number of replicates that give an interval: two groups.
pub const FEWEST_REPLICATES: u32 = 4;

/// Makes one truth per pair of `replicates`, of all the others. Replicates share one support, so that the pixels that scores are
/// pooled over stay the same.
pub fn truths_without_pairs(replicates: &[Replicate]) -> Result<Vec<Truth>, TruthError> {
    (0..replicates.len() / GROUP)
        .map(|pair| {
            let others = (replicates.iter().enumerate()).filter(|(at, _)| at / GROUP != pair);
            let others: Vec<Replicate> = (others.map(|(_, replicate)| replicate).zip(0..))
                .map(|(replicate, index)| Replicate {
                    index,
                    ..replicate.clone()
                })
                .collect();
            Truth::of(&others)
        })
        .collect()
}

/// Computes the interval, by [`jackknife`], of each of `metrics` that has a score against the whole truth and against the truth
/// without each of its pairs.
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
