//! What filters score over all scenes of a run.

use metrics::{ImageMetric, Measured, Metric, ObjectMetric, Region};
use serde::{Deserialize, Serialize};

use crate::Case;
use crate::bootstrap::bootstrap_noisy;

/// What is brought together.
pub(crate) const METRICS: [Metric; 5] = [
    Metric::Image(ImageMetric::Flip, Region::Moving),
    Metric::Image(ImageMetric::Psnr, Region::Moving),
    Metric::Object(ObjectMetric::LateralGrowth),
    Metric::Object(ObjectMetric::BleedLateral),
    Metric::LabelTotalVariation,
];

/// The mean over other scenes lies beyond either end of its interval with this probability.
const TAIL: f64 = 0.025;

/// One metric of one filter preset, or of one bar, over the scenes that it applies to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overall {
    /// `jump_flood:paper`, and behind that the form of the input where that is not as usual.
    pub filter: String,
    /// Whether it is a bar, and no filter.
    pub bar: bool,
    /// The shutter alignment that it is scored against.
    pub alignment: String,
    /// Name of the metric.
    pub metric: String,
    /// How many scenes, each variant of one counted.
    pub scenes: usize,
    /// Mean over the scenes, in the metric's unit.
    pub mean: f64,
    /// The lower and the upper end of the mean's 95 % interval.
    pub interval: [f64; 2],
}

impl Overall {
    /// Whether both are of one filter preset or bar.
    pub(crate) fn is_of_same(&self, other: &Self) -> bool {
        let key = |own: &Self| (own.bar, own.filter.clone(), own.alignment.clone());
        key(self) == key(other)
    }
}

/// Means over at least two scenes, in the order of the cases, with intervals from a bootstrap over scenes. Where scores have
/// intervals of their own, from the replicates of their truths, these widen it.
pub fn overall(cases: &[Case]) -> Vec<Overall> {
    let mut subjects: Vec<&Case> = Vec::new();
    for case in cases {
        if !subjects.iter().any(|subject| are_of_one(subject, case)) {
            subjects.push(case);
        }
    }
    let of_subject = |subject: &Case| {
        let cases: Vec<&Case> = (cases.iter())
            .filter(|case| are_of_one(subject, case))
            .collect();
        let means = METRICS.map(|metric| mean(&cases, metric));
        means.into_iter().flatten().collect::<Vec<_>>()
    };
    subjects.into_iter().flat_map(of_subject).collect()
}

/// Whether both are of the same filter preset or bar.
fn are_of_one(a: &Case, b: &Case) -> bool {
    let key = |case: &Case| (case.bar, case.name(), case.alignment.clone());
    key(a) == key(b)
}

fn mean(cases: &[&Case], metric: Metric) -> Option<Overall> {
    let name = metric.name();
    let values: Vec<[f64; 2]> = (cases.iter())
        .filter_map(|case| match case.scores.get(metric) {
            Measured::NotApplicable { .. } => None,
            Measured::Score(score) => {
                let interval = case.intervals.get(&name);
                Some([score.value, interval.map_or(0.0, |own| own.standard_error)])
            }
        })
        .collect();
    let count = values.len();
    (count >= 2).then(|| Overall {
        filter: cases[0].name(),
        bar: cases[0].bar,
        alignment: cases[0].alignment.clone(),
        metric: name,
        scenes: count,
        mean: values.iter().map(|[value, _]| value).sum::<f64>() / count as f64,
        interval: bootstrap_noisy(&values, TAIL),
    })
}
