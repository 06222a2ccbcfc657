//! Cell of the overview: one score of one case, with a link to the case.

use judge::{Finding, Level, Outcome};
use maud::{Markup, html};
use metrics::{Ideal, Measured, Metric};

use crate::address::case_anchor;
use crate::case::case_view::CaseView;
use crate::finding_text::{Status, interval_text, limit_text};

/// Smallest badness with a colour of its own, for scores on a logarithmic scale.
const LEAST: f64 = 1e-3;
/// Part of the scores, at either end, that have the strongest colour and no influence on the scale.
const OUTLIERS: f64 = 0.05;

/// Colours of a table: from blue, good, over the paper's colour to orange, bad.
pub struct Colors {
    ideal: Ideal,
    ends: Option<[f64; 2]>,
}

impl Colors {
    /// Spreads the colours over some scores, except the outliers among them.
    pub fn over(ideal: Ideal, scores: impl Iterator<Item = f64>) -> Self {
        let mut all: Vec<f64> = scores.map(|score| scale(ideal, score)).collect();
        all.sort_by(f64::total_cmp);
        let last = all.len().saturating_sub(1);
        let skipped = (OUTLIERS * last as f64).round() as usize;
        let ends = (!all.is_empty()).then(|| [all[skipped], all[last - skipped]]);
        Self { ideal, ends }
    }

    /// Finds class and strength, in percent, of a score's colour.
    fn of(&self, score: f64) -> Option<(&'static str, f64)> {
        let [low, high] = self.ends.filter(|[low, high]| high > low)?;
        let part = (scale(self.ideal, score) - low) / (high - low);
        let from_middle = 200.0 * (part.clamp(0.0, 1.0) - 0.5);
        let class = if from_middle < 0.0 { "good" } else { "bad" };
        Some((class, from_middle.abs()))
    }
}

/// Scales badness: equal steps are equal factors if 0 is perfect.
fn scale(ideal: Ideal, score: f64) -> f64 {
    match ideal {
        Ideal::Lowest | Ideal::Target(_) => ideal.badness(score).max(LEAST).ln(),
        Ideal::Highest => ideal.badness(score),
    }
}

/// Writes the cell of a case.
pub fn cell(metric: Metric, colors: &Colors, view: &CaseView) -> Markup {
    let case = view.case;
    let measured = case.measured(metric);
    let estimate = case.estimate(metric);
    let judged = find_judged(metric, view);
    let color = (estimate.filter(|_| !case.is_reference)).and_then(|score| colors.of(score));
    let fails = judged.is_some_and(|(finding, _)| finding.outcome == Outcome::Broken);
    html! {
        td class=(format!("{} {}", color.map_or("", |color| color.0), if fails { "required" } else { "" }).trim())
            style=[color.map(|(_, strength)| format!("--strength:{strength:.0}%"))]
            data-value=[estimate]
            title=[reason(&measured)] {
            a.case href=(format!("#{}", case_anchor(case))) {
                @if let Some((_, status)) = judged { (status) }
                (case.score_text(metric))
                @if let (Some(interval), Some(value)) = (case.interval(metric), measured.value()) {
                    span.unseen { ", " (interval_text(interval, value)) }
                }
                @if let Some((finding, status)) = judged {
                    span.unseen { ", " (status.word) ", required limit " (limit_text(finding)) }
                }
            }
        }
    }
}

/// Finds the required bound on a case's score, and the score's status; none if it has no such
/// bound, or does not apply.
fn find_judged<'a>(metric: Metric, view: &'a CaseView) -> Option<(&'a Finding, Status)> {
    let metric = view.case.scores.behind(metric);
    let mut findings = view.findings.iter();
    let finding =
        findings.find(|finding| finding.level == Level::Required && finding.metric == metric)?;
    Some((finding, Status::of(finding.outcome)?))
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
    fn colours_tell_005_from_012_despite_an_outlier() {
        let scores = [
            0.02, 0.04, 0.05, 0.06, 0.08, 0.1, 0.12, 0.15, 0.2, 0.25, 9.0,
        ];
        let colors = Colors::over(Ideal::Lowest, scores.into_iter());
        let (good, strong) = colors.of(0.05).unwrap();
        let (bad, weak) = colors.of(0.12).unwrap();
        assert_eq!([good, bad], ["good", "bad"]);
        assert!(strong + weak > 40.0, "{strong} {weak}");
        assert_eq!(colors.of(9.0), Some(("bad", 100.0)));
        let single = Colors::over(Ideal::Highest, [3.0].into_iter());
        assert_eq!(single.of(3.0), None);
    }
}
