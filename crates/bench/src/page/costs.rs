//! Section on the cost of filters, from the run's bench.json.

use maud::{Markup, html};
use measure::FilterId;
use metrics::Metric;
use report::numbers::mean;
use report::table::Column::{self, Plain};
use report::table::{grouped_table, scroll_table};
use report::{CaseTable, adapter_text};

use super::pareto::{Point, pareto_section};
use super::times::{milliseconds, spread};
use crate::{BASELINE, Bench, CaseCost, GROWTH_FROM, REACHES};

/// A filter of a run with its cost.
pub type TimedFilter<'a> = (&'a FilterId, &'a CaseCost);

/// Shows quality against time, passes, and cost against reach.
pub fn costs(table: &CaseTable, bench: &Bench, timed: &[TimedFilter]) -> Markup {
    html! {
        p.note { (provenance(bench)) }
        (pareto_section(&points(table, timed), &references(table)))
        (passes(timed))
        (reaches(bench))
    }
}

/// Explains how the page gets costs.
pub fn no_costs() -> Markup {
    html! {
        p {
            "This run has no bench.json. " code { "shuttertruth bench" }
            ", with the run's folder, times its filters; then report again."
        }
    }
}

fn provenance(bench: &Bench) -> String {
    format!(
        "Timed on {} at {}x{}, on {}: median of {} rounds by {}. Quality is from this run's pictures.",
        adapter_text(&bench.adapter),
        bench.width,
        bench.height,
        bench.frame_text(),
        bench.rounds,
        bench.clock_text()
    )
}

/// Measures FLIP and time of every timed filter. Filters of all shutters are in one chart, so FLIP
/// is against one shutter for all.
fn points(table: &CaseTable, timed: &[TimedFilter]) -> Vec<Point> {
    let point = |(filter, cost): &TimedFilter| {
        Some(Point {
            title: filter.to_string(),
            seconds: cost.seconds,
            error: mean_error(table, filter)?,
        })
    };
    timed.iter().filter_map(point).collect()
}

/// Measures the references' errors, which have no time.
fn references(table: &CaseTable) -> Vec<(String, f64)> {
    let all = table.filters.iter();
    all.filter(|filter| filter.is_reference)
        .filter_map(|reference| Some((reference.to_string(), mean_error(table, reference)?)))
        .collect()
}

/// Averages over the scenes that have an error.
fn mean_error(table: &CaseTable, filter: &FilterId) -> Option<f64> {
    let cases = table.cases_of(filter);
    mean(cases.filter_map(|(_, case)| case.estimate(Metric::CommonFlip)))
}

fn passes(timed: &[TimedFilter]) -> Markup {
    let bodies = html! {
        @for (filter, cost) in timed {
            tbody {
                tr.group {
                    th scope="row" { (filter.to_string()) }
                    (spread(&cost.seconds))
                    td { (cost.ratio.map_or("-".to_owned(), |ratio| format!("{:.2}", ratio.median))) }
                    td { (bytes_text(cost.bytes_per_pixel)) }
                }
                @for pass in &cost.passes {
                    tr.pass {
                        th scope="row" {
                            (pass.entry) @if pass.iterations > 1 { " x " (pass.iterations) }
                        }
                        (spread(&pass.seconds))
                        td {}
                        td { (bytes_text(pass.bytes_per_pixel)) }
                    }
                }
            }
        }
    };
    let caption = format!("Time of every pass; baseline: {BASELINE}");
    html! {
        (grouped_table(Some("passes"), "Time of every pass", Some(&caption), &[
            Plain("filter / pass"), Plain("ms"), Plain("quartiles"), Plain("x baseline"), Plain("bytes per pixel"),
        ], &bodies))
    }
}

fn bytes_text(bytes: Option<f64>) -> String {
    bytes.map_or("-".to_owned(), |bytes| format!("{bytes:.0}"))
}

fn reaches(bench: &Bench) -> Markup {
    let growth = format!("{} / {GROWTH_FROM}", REACHES[REACHES.len() - 1]);
    let mut titles = vec!["filter".to_owned()];
    titles.extend(REACHES.map(|pixels| format!("{pixels} px")));
    titles.push(growth);
    let columns: Vec<Column> = titles.iter().map(|title| Plain(title)).collect();
    let rows = html! {
        @for cost in &bench.reaches {
            tr {
                th scope="row" { (cost.filter) ":" (cost.preset) }
                @for point in &cost.points {
                    td { (point.seconds.map_or("-".to_owned(), |seconds| milliseconds(seconds.median))) }
                }
                td { (cost.growth.map_or("-".to_owned(), |growth| format!("{:.2}", growth.median))) }
            }
        }
    };
    let caption = "Cost against reach: milliseconds for motion of 8 to 256 pixels, with the filter set to cover it";
    scroll_table(None, "Cost against reach", Some(caption), &columns, &rows)
}
