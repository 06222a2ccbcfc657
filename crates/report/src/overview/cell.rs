//! One score in a table, against its bound.

use maud::{Markup, html};
use metrics::{Measured, Metric};

use super::score_tables::ScoreTable;
use crate::case::case_view::CaseView;
use crate::finding_text::Status;
use suite::Level;
use suite::{Finding, Outcome, limit_as_badness, number};

/// How far a value is from its limit as a part of that: -1 is perfect, 0 at the limit, 1 twice as bad as allowed, or worse.
pub fn distance(metric: Metric, value: f64, limit: f64) -> f64 {
    let ideal = metric.ideal();
    let limit = limit_as_badness(ideal, limit);
    let beyond = ideal.badness(value) - limit;
    match limit == 0.0 {
        true => beyond.signum() * f64::from(beyond != 0.0),
        false => (beyond / limit.abs()).clamp(-1.0, 1.0),
    }
}

/// The cell of the overview that leads to a case.
pub fn cell(table: &ScoreTable, page: &CaseView) -> Markup {
    let measured = table.headline.measured(page.case);
    let judged = judged(table, page);
    html! {
        td class=[judged.map(|(_, finding, status)| class(finding, status))]
            style=[judged.and_then(|(metric, finding, _)| strength(metric, &measured, finding))]
            data-value=[measured.value()]
            title=[reason(&measured)] {
            a href=(format!("#case-{}", page.index)) {
                @if let Some((_, _, status)) = judged {
                    span.sign aria-hidden="true" { (status.sign) }
                }
                (table.headline.text(page.case))
                @if let Some((_, finding, status)) = judged {
                    span.unseen { ", " (status.word) ", " (level(finding)) " limit " (number(finding.limit)) }
                }
            }
        }
    }
}

/// The bound on a case's score, and how the score stands to it; none where it has no bound, or does not apply.
fn judged<'a>(table: &ScoreTable, page: &'a CaseView) -> Option<(Metric, &'a Finding, Status)> {
    let metric = table.headline.metric(&page.case.scores)?;
    let name = metric.name();
    let finding = (page.findings.iter()).find(|finding| finding.metric == name)?;
    Some((metric, finding, Status::of(finding.outcome)?))
}

/// What fails a check stands out.
fn class(finding: &Finding, status: Status) -> String {
    let fails = finding.level == Level::Required && finding.outcome == Outcome::Broken;
    match fails {
        true => format!("{} required", status.word),
        false => status.word.to_owned(),
    }
}

fn level(finding: &Finding) -> &'static str {
    match finding.level {
        Level::Required => "required",
        Level::Report => "reported",
    }
}

/// How strong the colour is, in percent.
fn strength(metric: Metric, measured: &Measured, finding: &Finding) -> Option<String> {
    let far = distance(metric, measured.value()?, finding.limit).abs();
    Some(format!("--strength:{:.0}%", 100.0 * far))
}

fn reason(measured: &Measured) -> Option<&str> {
    match measured {
        Measured::Score(_) => None,
        Measured::NotApplicable { reason } => Some(reason),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_distance_is_a_part_of_the_limit_whichever_way_is_better() {
        for (metric, value, limit, expected) in [
            ("flip_moving", 0.0, 0.05, -1.0),
            ("flip_moving", 0.025, 0.05, -0.5),
            ("flip_moving", 0.05, 0.05, 0.0),
            ("flip_moving", 0.2, 0.05, 1.0),
            ("n_eq", 4.0, 8.0, 0.5),
            ("n_eq", 12.0, 8.0, -0.5),
            ("extent", 0.75, 0.5, -0.5),
            ("extent", 1.75, 0.5, 0.5),
            ("hole", 0.0, 0.0, 0.0),
            ("hole", 0.1, 0.0, 1.0),
        ] {
            let metric: Metric = metric.parse().unwrap();
            assert_eq!(distance(metric, value, limit), expected, "{metric} {value}");
        }
    }
}
