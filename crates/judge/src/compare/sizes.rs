//! Comparison of results at several picture sizes: does a small picture rank filters like a large
//! one?

use std::cmp::Ordering;
use std::collections::BTreeSet;

use frame::{Alignment, Size};
use measure::{Error, Random, SceneMean, TWO_SIDED, plain_mean};
use metrics::Metric;
use scene::SceneId;

use crate::results::Results;

/// Number of resamples of the scenes.
const RESAMPLES: usize = 2000;

/// Filters of one shutter, by one score at several picture sizes.
#[derive(Clone, Debug, PartialEq)]
pub struct SizeComparison {
    /// Shutter alignment of the filters.
    pub alignment: Alignment,
    /// Scenes in every mean.
    pub scenes: Vec<SceneId>,
    /// Picture size of each file of results.
    pub sizes: Vec<Size>,
    /// Filters, best first at the largest size.
    pub filters: Vec<FilterAtSizes>,
    /// Agreement of each size with the largest.
    pub agreement: Vec<Agreement>,
}

/// A filter preset at every size.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterAtSizes {
    /// `jump_flood:paper`
    pub name: String,
    /// Mean over the scenes and its 95 % CI, per size.
    pub means: Vec<SceneMean>,
    /// Rank by that mean, from 1, per size.
    pub ranks: Vec<usize>,
}

/// Agreement of a size with the largest on the order of filters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Kendall's tau of the means: 1 for the same order, 0 for no relation, -1 for the opposite
    /// order.
    pub tau: f64,
    /// 95 % CI of tau, by resampling the scenes; none for a single scene.
    pub interval: Option<[f64; 2]>,
    /// Pairs of filters that both sizes order alike.
    pub alike: usize,
    /// Pairs that both sizes order, in opposite ways.
    pub reversed: Vec<Reversal>,
    /// Pairs that only this size orders.
    pub only_here: usize,
    /// Pairs that only the largest size orders.
    pub only_at_largest: usize,
}

/// Two filters that a size and the largest size order in opposite ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Reversal {
    /// Filter that is better at the smaller size.
    pub better_here: String,
    /// Filter that is better at the largest size.
    pub better_at_largest: String,
    /// Mean difference, the second filter's score minus the first one's, at the smaller size and at
    /// the largest.
    pub differences: [f64; 2],
}

/// Scores of every filter at one size: `[filter][scene]`, smaller is better.
type Badness = Vec<Vec<f64>>;

/// Compares results of the same filters and scenes by a score, each with the last, which is the
/// largest; one comparison per shutter alignment. A size orders two filters if the 95 % CI of their
/// mean difference over scenes excludes 0. That needs five scenes.
///
/// Scenes and filters that one of them lacks are an error.
pub fn compare_sizes(results: &[&Results], metric: Metric) -> Result<Vec<SizeComparison>, Error> {
    let Some(last) = results.last() else {
        return Err(Error::Refused("no results to compare".to_owned()));
    };
    let alignments: BTreeSet<Alignment> = last.scores.iter().map(|score| score.alignment).collect();
    (alignments.into_iter())
        .map(|alignment| compare_group(results, last, alignment, metric))
        .collect()
}

fn compare_group(
    results: &[&Results],
    last: &Results,
    alignment: Alignment,
    metric: Metric,
) -> Result<SizeComparison, Error> {
    let scores = || (last.scores.iter()).filter(|score| score.alignment == alignment);
    let names: BTreeSet<&str> = scores().map(|score| score.name.as_str()).collect();
    // A still scene orders no filters, and has no score where nothing moves.
    let scenes: BTreeSet<&SceneId> = (scores())
        .filter(|score| score.score(metric).is_some())
        .map(|score| &score.scene)
        .collect();
    let read = |results: &&Results| -> Result<Badness, Error> {
        let filter = |name: &&str| {
            let scores = (scenes.iter()).map(|scene| find(results, scene, name, metric));
            scores.collect()
        };
        names.iter().map(filter).collect()
    };
    let badness: Vec<Badness> = results.iter().map(read).collect::<Result<_, Error>>()?;
    let at_largest = badness.last().expect("there are results");
    let names: Vec<&str> = names.into_iter().collect();
    let mut filters: Vec<FilterAtSizes> = (names.iter().enumerate())
        .map(|(index, name)| {
            let mean = |values: &Vec<f64>| plain_mean(values, TWO_SIDED);
            let rank = |size: &Badness| {
                let average = mean(&size[index]).mean;
                1 + size
                    .iter()
                    .filter(|other| mean(other).mean < average)
                    .count()
            };
            FilterAtSizes {
                name: (*name).to_owned(),
                means: badness.iter().map(|size| mean(&size[index])).collect(),
                ranks: badness.iter().map(rank).collect(),
            }
        })
        .collect();
    filters.sort_by_key(|filter| filter.ranks.last().copied());
    Ok(SizeComparison {
        alignment,
        scenes: scenes.into_iter().cloned().collect(),
        sizes: results.iter().map(|results| results.size).collect(),
        filters,
        agreement: (badness.iter())
            .map(|size| compare_order(&names, size, at_largest))
            .collect(),
    })
}

/// Finds how bad a filter is on a scene.
fn find(results: &Results, scene: &SceneId, name: &str, metric: Metric) -> Result<f64, Error> {
    let score = (results.scores.iter()).find(|score| score.scene == *scene && score.name == name);
    let value = score.and_then(|score| score.score(metric)).ok_or_else(|| {
        Error::Refused(format!(
            "{} has no {} of {name} on {scene}; run all sizes with the same scenes and filters",
            results.file_name(),
            metric.name()
        ))
    })?;
    Ok(metric.ideal().badness(value))
}

fn compare_order(names: &[&str], here: &Badness, largest: &Badness) -> Agreement {
    let scenes = here.first().map_or(0, Vec::len);
    let tau = |drawn: &[usize]| {
        let [here, largest] = [here, largest].map(|size| -> Vec<f64> {
            let sum = |values: &Vec<f64>| drawn.iter().map(|scene| values[*scene]).sum::<f64>();
            let filters = size.iter();
            filters
                .map(|values| sum(values) / drawn.len() as f64)
                .collect()
        });
        kendalls_tau(&here, &largest)
    };
    let all: Vec<usize> = (0..scenes).collect();
    let mut agreement = Agreement {
        tau: tau(&all),
        interval: (scenes > 1).then(|| bootstrap(scenes, &tau)),
        ..Agreement::default()
    };
    for first in 0..names.len() {
        for second in first + 1..names.len() {
            let [excess, others] = [here, largest].map(|size| difference(size, first, second));
            match (excess.side_of_zero(), others.side_of_zero()) {
                (None, None) => {}
                (Some(_), None) => agreement.only_here += 1,
                (None, Some(_)) => agreement.only_at_largest += 1,
                (Some(side), Some(other)) if side == other => agreement.alike += 1,
                (Some(side), Some(_)) => {
                    let (better, worse, sign) = match side {
                        Ordering::Greater => (first, second, 1.0),
                        _ => (second, first, -1.0),
                    };
                    agreement.reversed.push(Reversal {
                        better_here: names[better].to_owned(),
                        better_at_largest: names[worse].to_owned(),
                        differences: [sign * excess.mean, sign * others.mean],
                    });
                }
            }
        }
    }
    agreement
}

/// Computes the 95 % CI of a statistic of scenes by its percentiles over resamples (Efron 1979,
/// "Bootstrap methods: another look at the jackknife").
fn bootstrap(scenes: usize, statistic: &dyn Fn(&[usize]) -> f64) -> [f64; 2] {
    let mut random = Random(1);
    let mut values: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let drawn: Vec<usize> = (0..scenes).map(|_| random.below(scenes)).collect();
            statistic(&drawn)
        })
        .collect();
    values.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|part| values[(part * (RESAMPLES - 1) as f64).round() as usize])
}

/// Averages the second filter's excess over the first, over scenes.
fn difference(size: &Badness, first: usize, second: usize) -> SceneMean {
    let pairs = size[second].iter().zip(&size[first]);
    let differences: Vec<f64> = pairs.map(|(second, first)| second - first).collect();
    plain_mean(&differences, TWO_SIDED)
}

/// Computes Kendall's tau-b of two lists of values for the same things (Kendall 1945, "The
/// treatment of ties in ranking problems"). Returns 1 for constant lists, which do not contradict
/// each other.
fn kendalls_tau(a: &[f64], b: &[f64]) -> f64 {
    let (mut agree, mut pairs_a, mut pairs_b) = (0.0, 0.0, 0.0);
    for first in 0..a.len() {
        for second in first + 1..a.len() {
            let sign = |values: &[f64]| match values[first].total_cmp(&values[second]) {
                Ordering::Less => -1.0,
                Ordering::Equal => 0.0,
                Ordering::Greater => 1.0f64,
            };
            agree += sign(a) * sign(b);
            pairs_a += sign(a).abs();
            pairs_b += sign(b).abs();
        }
    }
    match pairs_a * pairs_b {
        0.0 => 1.0,
        pairs => agree / f64::sqrt(pairs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 3] = ["first", "second", "third"];

    #[test]
    fn kendalls_tau_is_that_of_a_hand_count() {
        // Of six pairs five agree and one does not.
        assert!(
            (kendalls_tau(&[1.0, 2.0, 3.0, 4.0], &[1.0, 3.0, 2.0, 4.0]) - 4.0 / 6.0).abs() < 1e-12
        );
        assert_eq!(kendalls_tau(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), -1.0);
        // One tie in the first list: two pairs of three are left there, and both agree.
        let expected = 2.0 / (2.0f64 * 3.0).sqrt();
        assert!((kendalls_tau(&[1.0, 1.0, 2.0], &[1.0, 2.0, 3.0]) - expected).abs() < 1e-12);
    }

    #[test]
    fn a_pair_is_reversed_only_if_both_sizes_order_it() {
        let better = vec![0.10, 0.11, 0.12, 0.13, 0.14, 0.15];
        let worse: Vec<f64> = better.iter().map(|value| value + 0.02).collect();
        // Between the two on average, and too scattered to differ from either.
        let noisy = vec![0.25, 0.02, 0.25, 0.02, 0.25, 0.02];
        let here = vec![better.clone(), worse.clone(), noisy.clone()];
        let largest = vec![worse, better, noisy];
        let agreement = compare_order(&NAMES, &here, &largest);
        assert_eq!(
            (
                agreement.alike,
                agreement.only_here,
                agreement.only_at_largest
            ),
            (0, 0, 0)
        );
        assert_eq!(agreement.reversed.len(), 1, "{agreement:?}");
        let reversal = &agreement.reversed[0];
        assert_eq!(reversal.better_here, "first");
        assert_eq!(reversal.better_at_largest, "second");
        assert!((reversal.differences[0] - 0.02).abs() < 1e-12);
        assert!((reversal.differences[1] + 0.02).abs() < 1e-12);
        assert_eq!(agreement.tau, -1.0);
    }

    #[test]
    fn an_interval_holds_the_share_of_the_scenes_that_disagree() {
        // Two filters; one scene of four reverses them by as much as the other three do not.
        let here = vec![vec![0.1; 4], vec![0.2; 4]];
        let largest = vec![vec![0.1, 0.1, 0.1, 0.4], vec![0.2, 0.2, 0.2, 0.1]];
        let agreement = compare_order(&NAMES[..2], &here, &largest);
        // The scene is drawn twice or more in a quarter of the resamples.
        assert_eq!(agreement.interval, Some([-1.0, 1.0]), "{agreement:?}");
    }

    #[test]
    fn a_size_agrees_with_itself() {
        let size = vec![vec![0.1; 5], vec![0.2; 5], vec![0.3; 5]];
        let agreement = compare_order(&NAMES, &size, &size);
        assert_eq!(
            (agreement.tau, agreement.alike, agreement.reversed.len()),
            (1.0, 3, 0)
        );
        assert_eq!(agreement.interval, Some([1.0, 1.0]));
    }
}
