//! Bounds of a case, with evidence for unmet ones.

use judge::{CROP, Finding, Level, number};
use maud::{Markup, html};

use super::case_view::{CaseView, Evidence};
use crate::address::case_anchor;
use crate::finding_text::{Status, Tally, finding_line, limit_text, way_out, worst_frame_text};
use crate::numbers::counted;
use crate::sequence::SEQUENCES_PAGE;

/// Lists the unmet required bounds of a run, each with a link to its case.
pub fn broken_bounds(pages: &[CaseView]) -> Markup {
    let broken: Vec<(&CaseView, &Finding)> = (pages.iter())
        .flat_map(|page| page.findings.iter().map(move |finding| (page, *finding)))
        .filter(|(_, finding)| finding.level == Level::Required && finding.outcome.is_notable())
        .collect();
    html! {
        @if !broken.is_empty() {
            details.failures {
                summary { "Required bounds that are not met: " (broken.len()) }
                ul {
                    @for (page, finding) in broken {
                        li {
                            a href=(format!("#{}", case_anchor(page.case))) {
                                (finding.scene) " / " (finding.filter)
                            }
                            ": " (finding_line(finding))
                            @if let Some(way_out) = way_out(finding) { "; " (way_out) }
                        }
                    }
                }
            }
        }
    }
}

/// Shows every bound of a case: unmet ones with evidence, the others as a count.
pub fn bounds(page: &CaseView) -> Markup {
    let explained = page.evidence.iter().any(Option::is_some);
    let [required, targets] =
        [Level::Required, Level::Report].map(|level| Tally::of(&page.findings, level));
    html! {
        section.verdicts {
            h3 { @if required.broken > 0 { "Why it failed" } @else { "Bounds and targets" } }
            @if page.findings.is_empty() { p { "This picture is held to no bound." } }
            @if required.all > 0 { p { (required.met) " of " (counted(required.all, "required bound")) " met." } }
            @if targets.all > 0 { p { (targets.met) " of " (counted(targets.all, "target")) " met; targets fail nothing." } }
            @if explained { (failure_pattern(page)) }
            @for (finding, evidence) in page.findings.iter().zip(&page.evidence) {
                @if let Some(evidence) = evidence { (finding_section(page, finding, evidence)) }
                @else if finding.is_of_sequence() && finding.outcome.is_notable() { (sequence_section(finding)) }
            }
        }
    }
}

/// Names the failure pattern that all scores together resemble most.
fn failure_pattern(page: &CaseView) -> Markup {
    html! {
        p.alike {
            @match page.findings.iter().find_map(|finding| finding.resembles.as_ref()) {
                Some(alike) => {
                    "The scores are most like those of the wrong blur " strong { (alike.decoy) }
                    (format!(": they differ by {:.0} % of its distance from perfect.", 100.0 * alike.distance))
                }
                None => {
                    "No known failure pattern matched (only " code { "check" } " looks for them)."
                }
            }
        }
    }
}

/// Shows a score of a sequence that does not meet its limit: the worst frame, and a link to play
/// it.
fn sequence_section(finding: &Finding) -> Markup {
    html! {
        div class=(verdict_class(finding)) {
            (verdict_head(finding))
            p {
                @if let Some(frame) = worst_frame_text(finding) { (sentence(&frame)) " (" code { (finding.pictures.display()) } "). " }
                "To see it play, open " code { (SEQUENCES_PAGE) } " next to run.json."
            }
        }
    }
}

fn sentence(text: &str) -> String {
    let (first, rest) = text.split_at(1);
    first.to_uppercase() + rest
}

fn verdict_class(finding: &Finding) -> String {
    format!(
        "verdict {}",
        Status::required_class(finding).unwrap_or_default()
    )
}

/// Words what was found, what is allowed, and the remedy.
fn verdict_head(finding: &Finding) -> Markup {
    html! {
        p { strong { (finding_line(finding)) } }
        (facts(finding))
        @if let Some(way_out) = way_out(finding) { p.note { (way_out) } }
    }
}

fn finding_section(page: &CaseView, finding: &Finding, evidence: &Evidence) -> Markup {
    let [x, y] = evidence.place;
    html! {
        div class=(verdict_class(finding)) {
            (verdict_head(finding))
            p {
                "Worst at (" (x) ", " (y) ") of " (evidence.map) ". "
                button.place type="button" data-x=(x) data-y=(y) { "Show it above" }
            }
            figure.crop data-x=(x) data-y=(y) data-map=(evidence.plane) {
                div.panels {
                    @for what in ["truth", "output", "error"] {
                        canvas width=(CROP.min(page.run.render.width)) height=(CROP.min(page.run.render.height)) role="img"
                            aria-label=(format!("{what} around ({x}, {y})")) {}
                    }
                }
                figcaption { "truth, output, " (evidence.map) " (as bright as it is here)" }
            }
        }
    }
}

/// Lists metric, limit, value and interval.
fn facts(finding: &Finding) -> Markup {
    html! {
        dl {
            div { dt { "metric" } dd { (finding.metric) ": " (finding.metric.meaning()) } }
            @if let Some(value) = finding.value {
                div { dt { "measured" } dd { (finding.with_unit(value)) } }
            }
            @if let Some(interval) = &finding.interval {
                div { dt { "95 % CI" } dd { (number(interval.low)) " to " (number(interval.high)) ", against a truth without noise" } }
            }
            div { dt { "limit" } dd { (limit_text(finding)) ", " (finding.place) ": " (finding.why) } }
            @if let Some(floor) = finding.floor {
                div { dt { "noise floor" } dd { (number(floor)) } }
            }
        }
    }
}
