//! The scores of a case, each with its floor and what it means.

use maud::{Markup, html};
use metrics::{Group, Measured, Metric};

use super::case_page::Page;
use super::cell::standing;
use suite::Case;
use suite::number;

/// All groups as one table.
pub fn score_rows(page: &Page) -> Markup {
    let case = page.case;
    let all = Metric::all();
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
            @for group in Group::SHOWN {
                tbody {
                    tr.group { th scope="rowgroup" colspan="5" { (group.title()) } }
                    @for metric in all.iter().filter(|metric| metric.group() == group) { (row(page, *metric)) }
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

fn row(page: &Page, metric: Metric) -> Markup {
    let case = page.case;
    let name = metric.name();
    let finding = (page.findings.iter()).find(|finding| finding.metric == name);
    let standing = finding.and_then(|finding| standing(finding.outcome));
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
                        @if let (Some(finding), Some(standing)) = (finding, standing) {
                            span.sign aria-hidden="true" { (standing.sign) }
                            (number(finding.limit))
                            span.unseen { ", " (standing.word) }
                        }
                    }
                }
            }
            td.meaning { (metric.meaning()) }
        }
    }
}

/// With its unit; counts of sub-frames with the end of the ladder that they lie beyond.
fn value(case: &Case, metric: Metric, value: f64) -> String {
    match metric {
        Metric::Equivalent(metric) => case.scores.equivalent_subframes.get(metric).to_string(),
        _ => match metric.unit() {
            "" => number(value),
            unit => format!("{} {unit}", number(value)),
        },
    }
}
