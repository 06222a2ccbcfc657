//! Means of filters over the scenes of a run.

use metrics::Metric;

use super::scene_mean::{TWO_SIDED, Weighted, scene_mean};
use crate::run::case::Case;
use crate::run::overall::Overall;

/// Computes means of estimated scores over at least two scenes, in the order of the cases, with
/// Student's intervals over scenes.
pub fn overall(cases: &[Case]) -> Vec<Overall> {
    let mut subjects: Vec<&Case> = Vec::new();
    for case in cases {
        if !subjects.iter().any(|subject| are_of_one(subject, case)) {
            subjects.push(case);
        }
    }
    let of_subject = |subject: &Case| {
        let subject_cases: Vec<&Case> = (cases.iter())
            .filter(|case| are_of_one(subject, case))
            .collect();
        let means = Metric::OF_MEANS.map(|metric| mean(&subject_cases, metric, cases));
        means.into_iter().flatten().collect::<Vec<_>>()
    };
    subjects.into_iter().flat_map(of_subject).collect()
}

/// Sorts the means of one score, best first, in one group per frame rate and shutter alignment,
/// with reference pictures among the filters. A score that compares across alignments has one group
/// per rate.
pub fn rank_filters(overall: &[Overall], metric: Metric) -> Vec<Vec<&Overall>> {
    let mut groups: Vec<Vec<&Overall>> = Vec::new();
    for mean in overall.iter().filter(|mean| mean.metric == metric) {
        let is_of = |group: &Vec<&Overall>| {
            group[0].rate == mean.rate
                && (metric.spans_alignments() || group[0].alignment == mean.alignment)
        };
        let group = groups.iter_mut().find(|group| is_of(group));
        match group {
            Some(group) => group.push(mean),
            None => groups.push(vec![mean]),
        }
    }
    let badness = |mean: &Overall| metric.ideal().badness(mean.mean);
    for group in &mut groups {
        group.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
    }
    groups
}

/// Returns whether both belong to the same filter preset or reference picture, at the same frame
/// rate.
fn are_of_one(a: &Case, b: &Case) -> bool {
    a.filter_id() == b.filter_id() && a.rate == b.rate
}

fn mean(subject_cases: &[&Case], metric: Metric, all: &[Case]) -> Option<Overall> {
    let scores: Vec<Weighted> = (subject_cases.iter())
        .filter_map(|case| {
            Some(Weighted {
                value: case.estimate(metric)?,
                weight: case.weight(metric, all)?,
            })
        })
        .collect();
    (scores.len() >= 2).then(|| {
        let average = scene_mean(&scores, TWO_SIDED);
        Overall {
            filter: subject_cases[0].filter_id(),
            rate: subject_cases[0].rate,
            metric,
            scenes: scores.len(),
            mean: average.mean,
            interval: average.interval,
        }
    })
}
