//! Filters by their means over scenes.

use maud::{Markup, html};
use metrics::Ideal;

use super::costs::{cost_of, cost_text};
use super::interval_chart::{Axis, interval_chart};
use super::shown::Shown;
use super::subject::{Subject, mean_floor, subjects};
use crate::{Bench, Overall, Run};

/// Best first, bars among them: mean, 95 % interval, and both in a picture. Nothing of a score without means.
pub fn ranking(run: &Run, shown: &Shown, bench: Option<&Bench>) -> Markup {
    let name = shown.metric.name();
    let ideal = shown.metric.ideal();
    let mut ranked: Vec<&Overall> = (run.overall.iter())
        .filter(|mean| mean.metric == name)
        .collect();
    ranked.sort_by(|a, b| ideal.badness(a.mean).total_cmp(&ideal.badness(b.mean)));
    if ranked.is_empty() {
        return html! {};
    }
    let subjects = subjects(run);
    let rows: Vec<(Option<&Subject>, &Overall)> = (ranked.into_iter())
        .map(|mean| (subjects.iter().find(|subject| subject.is_of(mean)), mean))
        .collect();
    let axis = Axis::over(rows.iter().map(|(_, mean)| mean.interval), ideal);
    let digits = shown.digits;
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("Ranking by {}", shown.title)) {
            table.ranking {
                caption { "Mean over scenes, best first; the line is its 95 % interval over scenes" }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th scope="col" { "mean" }
                        th scope="col" { "95 % in" }
                        th scope="col" { "scenes" }
                        th scope="col" { "cost, ms" }
                        th.chart scope="col" {
                            div.ends {
                                span { (format!("{:.digits$}", axis.low)) }
                                span.unseen { " to " }
                                span { (format!("{:.digits$}", axis.high)) }
                            }
                        }
                    }
                }
                tbody {
                    @for (subject, mean) in &rows {
                        tr.bar[mean.bar] {
                            th scope="row" {
                                (subject.map_or_else(|| mean.filter.clone(), Subject::title))
                            }
                            td { (format!("{:.digits$}", mean.mean)) }
                            td {
                                (format!("{:.digits$}–{:.digits$}", mean.interval[0], mean.interval[1]))
                            }
                            td { (mean.scenes) }
                            td { (cost_text(subject.and_then(|subject| cost_of(run, bench, subject)))) }
                            td.chart {
                                (interval_chart(&axis, mean, floor(run, *subject, shown, ideal)))
                            }
                        }
                    }
                }
            }
            p.note { "Grey: what the truth's own noise makes of the score, its floor. Open marks are bars." }
        }
    }
}

/// Only where less is better does a floor lie between perfect and the score.
fn floor(run: &Run, subject: Option<&Subject>, shown: &Shown, ideal: Ideal) -> Option<f64> {
    match ideal {
        Ideal::Lowest => mean_floor(run, subject?, shown.metric),
        Ideal::Highest | Ideal::Target(_) => None,
    }
}
