//! The scores of a case, each with its floor and what it means.

use maud::{Markup, html};
use metrics::{
    FrozenMetric, ImageMetric, Measured, Metric, ObjectMetric, ProbeMetric, Region, SkillMetric,
};

use super::cell::standing;
use super::meaning::meaning;
use crate::Case;
use crate::gate::number;

/// Scores that a reader looks at together.
struct Group {
    title: &'static str,
    metrics: &'static [Metric],
}

/// What a page shows of the scores in run.json.
const GROUPS: [Group; 6] = [
    Group {
        title: "What is seen",
        metrics: &[
            Metric::Image(ImageMetric::Flip, Region::Moving),
            Metric::Image(ImageMetric::Flip, Region::Support),
            Metric::Image(ImageMetric::FlipP95, Region::Moving),
            Metric::Image(ImageMetric::FlipHdr, Region::Moving),
            Metric::Image(ImageMetric::Psnr, Region::Moving),
            Metric::Image(ImageMetric::Ssim, Region::Moving),
            Metric::Image(ImageMetric::Flip, Region::Still),
            Metric::StaticContamination,
        ],
    },
    Group {
        title: "What it is worth",
        metrics: &[
            Metric::EquivalentSubframes,
            Metric::EquivalentSubframesFlip,
            Metric::EquivalentSubframesLabel,
            Metric::Skill(SkillMetric::Flip),
            Metric::Skill(SkillMetric::Mse),
            Metric::Skill(SkillMetric::LabelTotalVariation),
        ],
    },
    Group {
        title: "Whose time it is",
        metrics: &[
            Metric::LabelTotalVariation,
            Metric::LabelTotalVariationP95,
            Metric::OccluderContamination,
        ],
    },
    Group {
        title: "The worst mover's silhouette and mass",
        metrics: &[
            Metric::Object(ObjectMetric::LateralGrowth),
            Metric::Object(ObjectMetric::RowGain),
            Metric::Object(ObjectMetric::RowLoss),
            Metric::Object(ObjectMetric::BleedLateral),
            Metric::Object(ObjectMetric::BleedLeading),
            Metric::Object(ObjectMetric::BleedTrailing),
            Metric::Object(ObjectMetric::Misplacement),
            Metric::Object(ObjectMetric::Centroid),
            Metric::Object(ObjectMetric::Extent),
            Metric::Object(ObjectMetric::TvExcess),
            Metric::Object(ObjectMetric::Hole),
            Metric::Object(ObjectMetric::Deficit),
            Metric::Object(ObjectMetric::Energy),
        ],
    },
    Group {
        title: "What one instant can tell",
        metrics: &[
            Metric::Image(ImageMetric::Flip, Region::Knowable),
            Metric::Image(ImageMetric::Flip, Region::Unknowable),
            Metric::Frozen(FrozenMetric::Flip),
            Metric::Frozen(FrozenMetric::Shading),
        ],
    },
    Group {
        title: "What is gathered",
        metrics: &[
            Metric::Probe(ProbeMetric::Unity),
            Metric::Probe(ProbeMetric::GatherOffset),
            Metric::Probe(ProbeMetric::GatherSpread),
        ],
    },
];

/// All groups as one table.
pub fn score_rows(case: &Case) -> Markup {
    html! {
        table.scores {
            caption {
                "Scores; behind them, small, where they would lie against a truth without noise (95 %), and the object they are of. \
                 run.json holds more."
            }
            thead {
                tr {
                    th scope="col" { "score" }
                    th scope="col" { "value" }
                    th scope="col" { "floor" }
                    th scope="col" { "limit" }
                    th scope="col" { "what it says" }
                }
            }
            @for group in &GROUPS {
                tbody {
                    tr.group { th scope="rowgroup" colspan="5" { (group.title) } }
                    @for metric in group.metrics { (row(case, *metric)) }
                }
            }
            @if let Some(jitter) = &case.jitter {
                tbody {
                    tr.group { th scope="rowgroup" colspan="5" { "The filter's own noise" } }
                    tr {
                        th scope="row" { "noise" }
                        td { (format!("{:.0} %", 100.0 * jitter.noise_share())) }
                        td {}
                        td {}
                        td.meaning {
                            "part of the squared error that averaging takes away, by " (jitter.frames) " frames"
                        }
                    }
                }
            }
        }
    }
}

fn row(case: &Case, metric: Metric) -> Markup {
    let name = metric.name();
    let verdict = case.verdicts.iter().find(|verdict| verdict.metric == name);
    let standing = verdict.and_then(|verdict| standing(&verdict.outcome));
    html! {
        tr {
            th scope="row" { (name) }
            @match case.scores.get(metric) {
                Measured::NotApplicable { reason } => td.reason colspan="3" { "n/a: " (reason) },
                Measured::Score(score) => {
                    td {
                        (value(case, metric, score.value))
                        @if let Some(interval) = case.intervals.get(&name) {
                            span.note { " " (number(interval.low)) " to " (number(interval.high)) }
                        }
                        @if let Some((object, _)) = case.scores.worst_object(metric) {
                            span.note { " " (object) }
                        }
                    }
                    td data-label="floor" { (number(score.floor)) }
                    td class=[standing.map(|standing| standing.word)]
                        data-label=[standing.map(|_| "limit")] {
                        @if let (Some(verdict), Some(standing)) = (verdict, standing) {
                            span.sign aria-hidden="true" { (standing.sign) }
                            (number(verdict.limit))
                            span.unseen { ", " (standing.word) }
                        }
                    }
                }
            }
            td.meaning { (meaning(metric)) }
        }
    }
}

/// With its unit; counts of sub-frames with the end of the ladder that they lie beyond.
fn value(case: &Case, metric: Metric, value: f64) -> String {
    let equivalent = &case.scores.equivalent_subframes;
    match metric {
        Metric::EquivalentSubframes => equivalent.mse.to_string(),
        Metric::EquivalentSubframesFlip => equivalent.flip.to_string(),
        Metric::EquivalentSubframesLabel => equivalent.label_total_variation.to_string(),
        _ => match metric.unit() {
            "" => number(value),
            unit => format!("{} {unit}", number(value)),
        },
    }
}
