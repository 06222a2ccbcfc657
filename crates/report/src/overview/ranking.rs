//! Filters by their means over scenes.

use maud::{Markup, html};
use metrics::Ideal;

use super::costs::{cost_of, cost_text};
use super::score_tables::ScoreTable;
use crate::charts::strip::Strip;
use crate::filter_id::{FilterId, list_filters, mean_floor};
use suite::rank_filters;
use suite::{Bench, Overall, Run};

/// Columns of the table.
const COLUMNS: usize = 6;

/// Best first, references among them: mean, 95 % confidence interval, and both in a picture. Filters of one shutter alignment stand
/// together, unless the score compares across alignments. Nothing of a score without means.
pub fn ranking(run: &Run, table: &ScoreTable, bench: Option<&Bench>) -> Markup {
    let ideal = table.headline.ideal();
    let groups = rank_filters(&run.overall, table.headline);
    if groups.is_empty() {
        return html! {};
    }
    let strip = strip_over(groups.iter().flatten().map(|mean| mean.interval), ideal);
    let number = |value: f64| table.headline.number(value);
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("Ranking by {}", table.title)) {
            table.ranking {
                caption { (caption(table)) }
                thead {
                    tr {
                        th scope="col" { "filter" }
                        th scope="col" { "mean" }
                        th scope="col" { "95 % CI" }
                        th scope="col" { "scenes" }
                        th scope="col" { "cost, ms" }
                        th.chart scope="col" {
                            div.ends {
                                span { (number(strip.low)) }
                                span.unseen { " to " }
                                span { (number(strip.high)) }
                            }
                        }
                    }
                }
                @for group in &groups {
                    @if !table.headline.spans_alignments() {
                        tbody.group {
                            tr { th scope="rowgroup" colspan=(COLUMNS) { (group[0].alignment) " shutter" } }
                        }
                    }
                    tbody {
                        @for mean in group { (row(run, table, bench, &strip, mean)) }
                    }
                }
            }
            p.note { "Grey: what the truth's own noise makes of the score, its floor. Open marks are references." }
        }
    }
}

fn caption(table: &ScoreTable) -> &'static str {
    match table.headline.spans_alignments() {
        true => {
            "Mean over scenes, best first, of filters of all shutters; the line is its 95 % CI over scenes"
        }
        false => {
            "Mean over scenes, best first within each shutter; the line is its 95 % CI over scenes. Two shutters do not compare"
        }
    }
}

fn row(
    run: &Run,
    table: &ScoreTable,
    bench: Option<&Bench>,
    strip: &Strip,
    mean: &Overall,
) -> Markup {
    let number = |value: f64| table.headline.number(value);
    let filters = list_filters(run);
    let filter = filters.iter().find(|filter| filter.is_of(mean));
    html! {
        tr.reference[mean.bar] {
            th scope="row" {
                (mean.filter)
                @if table.headline.spans_alignments() { " " span.note { "(" (mean.alignment) ")" } }
            }
            td { (number(mean.mean)) }
            td { (number(mean.interval[0])) " to " (number(mean.interval[1])) }
            td { (mean.scenes) }
            td { (cost_text(filter.and_then(|filter| cost_of(run, bench, filter)))) }
            td.chart {
                (mean_strip(strip, mean, floor(run, filter, table)))
            }
        }
    }
}

/// Only where less is better does a floor lie between perfect and the score.
fn floor(run: &Run, filter: Option<&FilterId>, table: &ScoreTable) -> Option<f64> {
    match table.headline.ideal() {
        Ideal::Lowest => mean_floor(run, filter?, table.headline),
        Ideal::Highest | Ideal::Target(_) => None,
    }
}

/// Makes a scale over all of some intervals, and from perfect where that is known.
fn strip_over(intervals: impl Iterator<Item = [f64; 2]>, ideal: Ideal) -> Strip {
    let perfect = match ideal {
        Ideal::Lowest => Some(0.0),
        Ideal::Target(target) => Some(target),
        Ideal::Highest => None,
    };
    Strip::over(intervals.flatten().chain(perfect))
}

/// Draws a mean with its interval, and the floor below which the truth's noise hides it.
fn mean_strip(strip: &Strip, mean: &Overall, floor: Option<f64>) -> Markup {
    let class = if mean.bar { "open" } else { "" };
    strip.draw(&html! {
        @if let Some(floor) = floor { (strip.bar(0.0, floor, "floor")) }
        (strip.interval(mean.interval))
        (strip.mark(mean.mean, class))
    })
}
