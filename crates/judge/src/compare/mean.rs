//! Changes of means over all scenes between two runs.

use std::cmp::Ordering;

use measure::{MIN_SCENES, TWO_SIDED, Weighted, scene_mean};
use metrics::Metric;
use serde::Serialize;

use crate::compare::change::{Change, ChangeKind};
use crate::groups::group_by;

/// Mean of one metric of one filter, over the scenes that it applies to in both runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeanChange {
    /// `jump_flood:paper`, followed by the scenes' frame rate if it is not their files':
    /// `jump_flood:paper 24fps`.
    pub filter: String,
    /// Score.
    pub metric: Metric,
    /// Number of scenes.
    pub scenes: usize,
    /// Numbers of scenes that are better, and worse, by more than noise.
    pub better_worse: [usize; 2],
    /// Mean of the first run's estimates, in the metric's unit; for a skill the ratio of means, as
    /// in run.json.
    pub first: f64,
    /// Mean of the second run's estimates.
    pub second: f64,
    /// Mean of the estimated changes for the worse; negative is better.
    pub worse: f64,
    /// 95 % confidence interval of `worse`, over scenes.
    pub interval: [f64; 2],
    /// Verdict.
    pub kind: ChangeKind,
}

/// Averages changes per filter, metric and frame rate, in the order of the changes; leaves out
/// references.
pub fn average_changes(changes: &[Change]) -> Vec<MeanChange> {
    let of_filters = changes.iter().filter(|change| !change.filter.is_reference);
    let groups = group_by(of_filters, |change| {
        (&change.filter, change.scene.rate, change.metric)
    });
    groups.iter().map(|group| average(group)).collect()
}

fn average(changes: &[&Change]) -> MeanChange {
    let count = changes.len();
    let mean = |value: fn(&Change) -> f64| {
        let weighted = changes.iter().map(|change| Weighted {
            value: value(change),
            weight: change.weight,
        });
        scene_mean(&weighted.collect::<Vec<_>>(), TWO_SIDED)
    };
    let worse = mean(Change::estimate);
    let of_kind = |kind| changes.iter().filter(|change| change.kind == kind).count();
    let first = changes[0];
    MeanChange {
        filter: match first.scene.rate {
            Some(rate) => format!("{} {}", first.filter, rate.word()),
            None => first.filter.to_string(),
        },
        metric: first.metric,
        scenes: count,
        better_worse: [of_kind(ChangeKind::Better), of_kind(ChangeKind::Worse)],
        first: mean(|change| change.estimates[0]).mean,
        second: mean(|change| change.estimates[1]).mean,
        worse: worse.mean,
        interval: worse.interval,
        kind: match worse.side_of_zero() {
            _ if of_kind(ChangeKind::Same) == count => ChangeKind::Same,
            _ if count < MIN_SCENES => ChangeKind::TooFewScenes,
            Some(Ordering::Greater) => ChangeKind::Worse,
            Some(Ordering::Less) => ChangeKind::Better,
            _ => ChangeKind::Undecided,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::change::tests::change;

    /// One filter on as many scenes as there are numbers, which say how much worse each is.
    fn changes(worse: &[f64]) -> Vec<Change> {
        let change = |(index, worse): (usize, &f64)| {
            let kind = match *worse {
                0.0 => ChangeKind::Same,
                worse if worse > 0.0 => ChangeKind::Worse,
                _ => ChangeKind::Better,
            };
            change(&format!("scene_{index}"), Metric::FLIP, *worse, kind)
        };
        worse.iter().enumerate().map(change).collect()
    }

    #[test]
    fn a_mean_is_worse_where_other_scenes_would_say_so_too() {
        for (worse, expected) in [
            (&[0.1, 0.2, 0.1, 0.2, 0.1][..], ChangeKind::Worse),
            (&[-0.1, -0.2, -0.1, -0.2, -0.1], ChangeKind::Better),
            (&[-0.3, 0.2, 0.1, -0.2, 0.1], ChangeKind::Undecided),
            (&[0.1, 0.2, 0.1, 0.2], ChangeKind::TooFewScenes),
            (&[0.0, 0.0], ChangeKind::Same),
        ] {
            let means = average_changes(&changes(worse));
            assert_eq!(means.len(), 1);
            assert_eq!(means[0].kind, expected, "{worse:?}");
            assert_eq!(means[0].scenes, worse.len());
        }
    }

    #[test]
    fn a_mean_of_skills_counts_scenes_by_what_is_to_be_gained_on_them() {
        let mut all = changes(&[0.1, 0.4]);
        all[0].weight = 3.0;
        assert!((average_changes(&all)[0].worse - 0.175).abs() < 1e-12);
    }

    #[test]
    fn a_mean_is_of_estimates() {
        let mut all = changes(&[0.1, 0.3]);
        for (change, estimate) in all.iter_mut().zip([0.2, 0.4]) {
            change.interval = Some([estimate - 0.05, estimate + 0.05]);
            change.estimates = [0.4, 0.4 + estimate];
        }
        let mean = &average_changes(&all)[0];
        for (value, expected) in [(mean.first, 0.4), (mean.second, 0.7), (mean.worse, 0.3)] {
            assert!((value - expected).abs() < 1e-12, "{mean:?}");
        }
    }

    #[test]
    fn frame_rates_have_means_of_their_own() {
        let mut all = changes(&[0.1, 0.1, 0.3, 0.3]);
        for change in &mut all[2..] {
            change.scene.rate = scene::FrameRate::in_word("24fps");
        }
        let means = average_changes(&all);
        let counts: Vec<(&str, usize)> = (means.iter())
            .map(|mean| (mean.filter.as_str(), mean.scenes))
            .collect();
        assert_eq!(counts, [("one:paper", 2), ("one:paper 24fps", 2)]);
        assert!((means[1].worse - 0.3).abs() < 1e-12);
    }
}
