//! Filters by their means over scenes.

use maud::{Markup, html};
use metrics::Ideal;

use super::costs::{cost_of, cost_text};
use super::interval_chart::{Axis, interval_chart};
use super::shown::Shown;
use super::subject::{Subject, mean_floor, subjects};
use suite::rank_filters;
use suite::{Bench, Overall, Run};

/// Columns of the table.
const COLUMNS: usize = 6;

/// Best first, bars among them: mean, 95 % confidence interval, and both in a picture. Filters of one shutter alignment stand
/// together, unless the score compares across alignments. Nothing of a score without means.
pub fn ranking(run: &Run, shown: &Shown, bench: Option<&Bench>) -> Markup {
    let ideal = shown.headline.ideal();
    let groups = rank_filters(&run.overall, shown.headline);
    if groups.is_empty() {
        return html! {};
    }
    let axis = Axis::over(groups.iter().flatten().map(|mean| mean.interval), ideal);
    let number = |value: f64| shown.headline.number(value);
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("Ranking by {}", shown.title)) {
            table.ranking {
                caption { (caption(shown)) }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th scope="col" { "mean" }
                        th scope="col" { "95 % CI" }
                        th scope="col" { "scenes" }
                        th scope="col" { "cost, ms" }
                        th.chart scope="col" {
                            div.ends {
                                span { (number(axis.low)) }
                                span.unseen { " to " }
                                span { (number(axis.high)) }
                            }
                        }
                    }
                }
                @for group in &groups {
                    @if !shown.headline.spans_alignments() {
                        tbody.group {
                            tr { th scope="rowgroup" colspan=(COLUMNS) { (group[0].alignment) " shutter" } }
                        }
                    }
                    tbody {
                        @for mean in group { (row(run, shown, bench, &axis, mean)) }
                    }
                }
            }
            p.note { "Grey: what the truth's own noise makes of the score, its floor. Open marks are bars." }
        }
    }
}

fn caption(shown: &Shown) -> &'static str {
    match shown.headline.spans_alignments() {
        true => {
            "Mean over scenes, best first, of filters of all shutters; the line is its 95 % CI over scenes"
        }
        false => {
            "Mean over scenes, best first within each shutter; the line is its 95 % CI over scenes. Two shutters do not compare"
        }
    }
}

fn row(run: &Run, shown: &Shown, bench: Option<&Bench>, axis: &Axis, mean: &Overall) -> Markup {
    let number = |value: f64| shown.headline.number(value);
    let subjects = subjects(run);
    let subject = subjects.iter().find(|subject| subject.is_of(mean));
    html! {
        tr.bar[mean.is_reference] {
            th scope="row" {
                (mean.filter)
                @if shown.headline.spans_alignments() { " " span.note { "(" (mean.alignment) ")" } }
            }
            td { (number(mean.mean)) }
            td { (number(mean.interval[0])) " to " (number(mean.interval[1])) }
            td { (mean.scenes) }
            td { (cost_text(subject.and_then(|subject| cost_of(run, bench, subject)))) }
            td.chart {
                (interval_chart(axis, mean, floor(run, subject, shown)))
            }
        }
    }
}

/// Only where less is better does a floor lie between perfect and the score.
fn floor(run: &Run, subject: Option<&Subject>, shown: &Shown) -> Option<f64> {
    match shown.headline.ideal() {
        Ideal::Lowest => mean_floor(run, subject?, shown.headline),
        Ideal::Highest | Ideal::Target(_) => None,
    }
}
