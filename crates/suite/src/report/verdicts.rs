//! Bounds that are not kept, and why.

use maud::{Markup, html};

use super::case_page::Page;
use super::cell::standing;
use crate::bounds::Level;
use crate::gate::{Finding, Kind, headline, way_out};

/// The required bounds of a run that are not kept, each with the way to its case.
pub fn broken_bounds(pages: &[Page]) -> Markup {
    let broken: Vec<(&Page, &Finding)> = (pages.iter())
        .flat_map(|page| page.findings.iter().map(move |finding| (page, finding)))
        .filter(|(_, finding)| finding.level == Level::Required && is_notable(finding))
        .collect();
    html! {
        @if !broken.is_empty() {
            details.failures open[broken.len() <= 12] {
                summary { "Required bounds that are not kept: " (broken.len()) }
                ul {
                    @for (page, finding) in broken {
                        li {
                            a href=(format!("#case-{}", page.index)) {
                                (finding.scene) " / " (finding.filter)
                            }
                            ": " (headline(finding))
                        }
                    }
                }
            }
        }
    }
}

/// Every bound of a case: what is not kept with its evidence, the others as a count.
pub fn verdicts(page: &Page) -> Markup {
    let kept = (page.findings.iter()).filter(|finding| finding.kind == Kind::Kept);
    let kept = kept.count();
    let notable = || (page.findings.iter().zip(&page.crops)).filter(|(own, _)| is_notable(own));
    html! {
        section.verdicts {
            h3 { "Bounds" }
            @match page.findings.len() {
                0 => p { "This picture is held to no bound." },
                all => p { (kept) " of " (all) " kept." },
            }
            @for (finding, crop) in notable() {
                (verdict(page, finding, *crop))
            }
            @if let Some(alike) = &page.case.resembles {
                p.alike {
                    "The scores are most like those of the wrong blur " strong { (alike.decoy) } ", "
                    (format!("{:.0}", 100.0 * alike.distance)) " % off."
                }
            }
        }
    }
}

/// `crop` is the number of the picture of the worst place.
fn verdict(page: &Page, finding: &Finding, crop: Option<usize>) -> Markup {
    let class = (page.case.verdicts.iter())
        .find(|verdict| verdict.metric == finding.metric)
        .and_then(|verdict| standing(&verdict.outcome))
        .map(|standing| standing.word);
    html! {
        div class=(format!("verdict {}", class.unwrap_or_default())) {
            p { strong { (headline(finding)) } }
            p.note { (finding.place) ": " (finding.why) }
            @if let Some(way_out) = way_out(finding) { p.note { (way_out) } }
            @if let Some(worst) = &finding.worst {
                p {
                    "Worst at (" (worst.x) ", " (worst.y) ") of " (worst.map) ". "
                    button.place type="button" data-x=(worst.x) data-y=(worst.y) { "Show it above" }
                }
                @if let Some(crop) = crop {
                    figure {
                        img data-picture=(crop)
                            alt=(format!(
                                "Truth, output and error around ({}, {}), side by side", worst.x, worst.y
                            ));
                        figcaption { "truth, output, error" }
                    }
                }
            }
        }
    }
}

fn is_notable(finding: &Finding) -> bool {
    matches!(
        finding.kind,
        Kind::Broken | Kind::Inconclusive | Kind::TooNoisy
    )
}
