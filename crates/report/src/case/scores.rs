//! Table of a case's scores, each with its noise floor and its meaning.

use judge::number;
use maud::{Markup, html};
use measure::Case;
use metrics::{Group, Measured, Metric};

use super::case_view::CaseView;
use crate::finding_text::{Status, interval_text, limit_text};
use crate::table::Column::Plain;
use crate::table::grouped_table;

const CAPTION: &str = "Scores, estimated without the truth's noise where there is a 95 % CI; grey: the interval, and the object that the \
                       score is about. run.json holds more.";

/// Lists the scores of all groups.
pub fn score_rows(page: &CaseView) -> Markup {
    let all = Metric::all();
    let bodies = html! {
        @for group in Group::SHOWN {
            tbody {
                tr.group { th scope="rowgroup" colspan="5" { (group.title()) } }
                @for metric in all.iter().filter(|metric| metric.group() == group) { (row(page, *metric)) }
            }
        }
        @if let Some(jitter) = &page.case.jitter {
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
    };
    let columns = ["score", "value", "floor", "limit", "what it says"].map(Plain);
    grouped_table(Some("scores"), "Scores", Some(CAPTION), &columns, &bodies)
}

fn row(page: &CaseView, metric: Metric) -> Markup {
    let case = page.case;
    let finding = (page.findings.iter().copied()).find(|finding| finding.metric == metric);
    let status = finding.and_then(|finding| Status::of(finding.outcome));
    let required = finding.and_then(Status::required_class);
    html! {
        tr {
            th scope="row" { (metric) }
            @match case.scores.get(metric) {
                Measured::NotApplicable { reason } => td.reason colspan="3" { "n/a: " (reason) },
                Measured::Score(score) => {
                    td {
                        @let interval = case.intervals.get(&metric);
                        (value(case, metric, interval.map_or(score.value, |interval| interval.center)))
                        @if let Some(interval) = interval { span.note { " " (interval_text(interval, score.value)) } }
                        @if let Some((object, _)) = case.scores.worst_object(metric) {
                            span.note { " " (object) }
                        }
                    }
                    td data-label="floor" { (number(score.floor)) }
                    td class=[required] data-label=[status.map(|_| "limit")] {
                        @if let (Some(finding), Some(status)) = (finding, status) {
                            (status) (limit_text(finding))
                            @if let Some(word) = required { span.unseen { ", " (word) } } @else { span.note { " target" } }
                        }
                    }
                }
            }
            td.meaning { (metric.meaning()) }
        }
    }
}

/// Formats a value with its unit, and for a count of sub-frames beyond the ladder the end of the
/// ladder.
fn value(case: &Case, metric: Metric, value: f64) -> String {
    match metric {
        Metric::Equivalent(metric) => case.scores.equivalent_subframes.get(metric).to_string(),
        _ => match metric.unit() {
            "" => number(value),
            unit => format!("{} {unit}", number(value)),
        },
    }
}
