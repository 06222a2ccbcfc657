//! Means of filters over all scenes of a run.

use metrics::Measured;
use serde::{Deserialize, Serialize};

use super::headline::Headline;
use super::scene_mean::{TWO_SIDED, Weighted, scene_mean};
use crate::Case;

/// One metric of one filter preset, or of one bar, over the scenes that it applies to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overall {
    /// `jump_flood:paper`, and behind that the form of the input where that is not as usual.
    pub filter: String,
    /// Whether it is a bar, and no filter.
    pub bar: bool,
    /// The shutter alignment that it is scored against.
    pub alignment: String,
    /// Name of the metric, `bleed` or `flip_common`.
    pub metric: String,
    /// How many scenes, each variant of one counted.
    pub scenes: usize,
    /// Mean over the scenes, in the metric's unit; of a skill the ratio of means.
    pub mean: f64,
    /// The lower and the upper end of the mean's 95 % confidence interval over scenes.
    pub interval: [f64; 2],
}

impl Overall {
    /// Whether both are of one filter preset or bar.
    pub fn is_of_same(&self, other: &Self) -> bool {
        let key = |own: &Self| (own.bar, own.filter.clone(), own.alignment.clone());
        key(self) == key(other)
    }
}

/// Means over at least two scenes, in the order of the cases, with Student's intervals over scenes.
pub fn overall(cases: &[Case]) -> Vec<Overall> {
    let mut subjects: Vec<&Case> = Vec::new();
    for case in cases {
        if !subjects.iter().any(|subject| are_of_one(subject, case)) {
            subjects.push(case);
        }
    }
    let of_subject = |subject: &Case| {
        let own: Vec<&Case> = (cases.iter())
            .filter(|case| are_of_one(subject, case))
            .collect();
        let means = Headline::OF_MEANS.map(|headline| mean(&own, headline, cases));
        means.into_iter().flatten().collect::<Vec<_>>()
    };
    subjects.into_iter().flat_map(of_subject).collect()
}

/// The means of one score, the best first: those of filters of one shutter alignment beside the bars of that alignment. One
/// group, of all alignments, of a score that compares across them.
pub fn rank_filters(overall: &[Overall], headline: Headline) -> Vec<Vec<&Overall>> {
    let name = headline.name();
    let mut groups: Vec<Vec<&Overall>> = Vec::new();
    for mean in overall.iter().filter(|mean| mean.metric == name) {
        let group = (groups.iter_mut())
            .find(|group| headline.spans_alignments() || group[0].alignment == mean.alignment);
        match group {
            Some(group) => group.push(mean),
            None => groups.push(vec![mean]),
        }
    }
    let badness = |mean: &Overall| headline.ideal().badness(mean.mean);
    for group in &mut groups {
        group.sort_by(|a, b| badness(a).total_cmp(&badness(b)));
    }
    groups
}

/// Whether both are of the same filter preset or bar.
fn are_of_one(a: &Case, b: &Case) -> bool {
    let key = |case: &Case| (case.bar, case.name(), case.alignment.clone());
    key(a) == key(b)
}

fn mean(own: &[&Case], headline: Headline, all: &[Case]) -> Option<Overall> {
    let scores: Vec<Weighted> = (own.iter())
        .filter_map(|case| match headline.measured(case) {
            Measured::NotApplicable { .. } => None,
            Measured::Score(score) => Some(Weighted {
                value: score.value,
                weight: headline.weight(case, all)?,
            }),
        })
        .collect();
    (scores.len() >= 2).then(|| {
        let found = scene_mean(&scores, TWO_SIDED);
        Overall {
            filter: own[0].name(),
            bar: own[0].bar,
            alignment: own[0].alignment.clone(),
            metric: headline.name(),
            scenes: scores.len(),
            mean: found.mean,
            interval: found.interval,
        }
    })
}
