//! Jackknife intervals of scores, from truths without one pair of replicates each.

use frame::{Replicate, Truth, TruthError};
use metrics::{
    Equivalent, Interval, Measured, Metric, Scores, SequenceMetric, SequenceScores, jackknife,
    jackknife_of_percentile,
};
use store::LADDER;

use crate::run::case::Intervals;

/// First and last number of sub-frames of the ladder.
const LADDER_ENDS: [u32; 2] = [LADDER[0], LADDER[LADDER.len() - 1]];

/// Replicates that are left out together: one of each half, so that the halves stay equally large.
const GROUP: usize = 2;

/// Smallest number of replicates for an interval: two groups.
pub const MIN_REPLICATES: u32 = 4;

/// Makes one truth per pair of `replicates`, from all the others. Replicates share one support, so that scores keep pooling over the same
/// pixels.
pub fn truths_without_pairs(replicates: &[Replicate]) -> Result<Vec<Truth>, TruthError> {
    (0..count_pairs(replicates.len()))
        .map(|pair| truth_without_pair(replicates, pair))
        .collect()
}

/// Counts the pairs of a number of replicates.
pub(crate) fn count_pairs(replicates: usize) -> usize {
    replicates / GROUP
}

/// Makes the truth of all replicates except one pair.
pub(crate) fn truth_without_pair(
    replicates: &[Replicate],
    pair: usize,
) -> Result<Truth, TruthError> {
    let others = (replicates.iter().enumerate()).filter(|(at, _)| at / GROUP != pair);
    let others: Vec<Replicate> = (others.map(|(_, replicate)| replicate).zip(0..))
        .map(|(replicate, index)| Replicate {
            index,
            ..replicate.clone()
        })
        .collect();
    Truth::of(&others)
}

/// Computes the interval, by [`jackknife`] or [`jackknife_of_percentile`], of each of `metrics` that has a score against the whole truth
/// and against the truth without each of its pairs. Counts of equivalent sub-frames have an interval of their own, with the ladder's ends
/// for open ends.
pub fn intervals(
    whole: &Scores,
    without: &[Scores],
    metrics: impl IntoIterator<Item = Metric>,
) -> Intervals {
    (metrics.into_iter())
        .filter_map(|metric| {
            if let Metric::Equivalent(count) = metric {
                return match whole.equivalent_subframes.get(count) {
                    Equivalent::Subframes(count) => Some((metric, count.interval(LADDER_ENDS))),
                    Equivalent::NotApplicable { .. } => None,
                };
            }
            let without = without.iter().map(|scores| scores.get(metric));
            let found = interval(&whole.get(metric), without, metric.row().is_percentile)?;
            Some((metric, found))
        })
        .collect()
}

/// Computes the intervals of a sequence's scores like [`intervals`] for a picture.
pub(crate) fn sequence_intervals(whole: &SequenceScores, without: &[SequenceScores]) -> Intervals {
    (SequenceMetric::ALL.into_iter())
        .filter_map(|metric| {
            let row = metric.row();
            let without = without.iter().map(|scores| scores.get(metric).clone());
            let found = interval(whole.get(metric), without, row.is_percentile)?;
            Some((Metric::Sequence(metric), found))
        })
        .collect()
}

/// Computes the interval of one score; none if it does not apply to every truth.
fn interval(
    whole: &Measured,
    without: impl Iterator<Item = Measured>,
    is_percentile: bool,
) -> Option<Interval> {
    let Measured::Score(score) = whole else {
        return None;
    };
    let without: Option<Vec<f64>> = without.map(|score| score.value()).collect();
    let (value, without) = (score.value, without?);
    match is_percentile {
        true => jackknife_of_percentile(value, &without, score.floor),
        false => jackknife(value, &without),
    }
}
