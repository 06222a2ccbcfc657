//! All scenes and all filters at a glance.

use maud::{Markup, html};
use metrics::Ideal;

use super::case_page::Page;
use super::cell::cell;
use super::costs::{cost_of, cost_text, costs};
use super::provenance::provenance;
use super::ranking::ranking;
use super::shown::{SHOWN, Shown};
use super::subject::{alignments, case_of, scenes, subjects};
use super::verdicts::broken_bounds;
use suite::CaseCost;
use suite::Outcome;
use suite::{Bench, Run};

/// The first thing that a reader sees.
pub fn overview(run: &Run, pages: &[Page], bench: Option<&Bench>) -> Markup {
    html! {
        section #overview {
            p.lead { (summary(run, pages)) }
            (broken_bounds(pages))
            fieldset.choice #metrics {
                legend { "Score" }
                @for (index, shown) in SHOWN.iter().enumerate() {
                    label {
                        input type="radio" name="metric" value=(shown.headline.name()) checked[index == 0];
                        span { (shown.title) }
                    }
                }
            }
            @for shown in &SHOWN { (panel(run, pages, shown, bench)) }
            (key())
            (costs(run, bench))
            (provenance(run))
        }
    }
}

/// `5 scenes, 23 filters; 230 bounds: 180 kept, 50 broken`
fn summary(run: &Run, pages: &[Page]) -> String {
    let all = subjects(run);
    let filters = all.iter().filter(|subject| !subject.bar).count();
    let mut text = format!(
        "{} and {}, beside {}.",
        counted(scenes(run).len(), "scene"),
        counted(filters, "filter preset"),
        counted(all.len() - filters, "bar"),
    );
    let findings = || pages.iter().flat_map(|page| &page.findings);
    let count = |outcome| (findings().filter(|finding| finding.outcome == outcome)).count();
    match findings().count() {
        0 => text += " No score is bounded.",
        bounds => {
            text += &format!(
                " {}: {} kept, {} broken, {} inconclusive, {} stricter than the noise allows, {} not applicable.",
                counted(bounds, "bound"),
                count(Outcome::Kept),
                count(Outcome::Broken),
                count(Outcome::Inconclusive),
                count(Outcome::TooNoisy),
                count(Outcome::NotApplicable),
            );
        }
    }
    text
}

/// `1 scene`, `2 scenes`.
fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}

fn panel(run: &Run, pages: &[Page], shown: &Shown, bench: Option<&Bench>) -> Markup {
    html! {
        div.panel data-metric=(shown.headline.name()) {
            h2 { (shown.title) }
            p { (shown.meaning()) "; " (shown.better()) "." }
            (ranking(run, shown, bench))
            (table(run, pages, shown, bench))
        }
    }
}

/// One row per filter preset or bar, those of one shutter together; one column per scene.
fn table(run: &Run, pages: &[Page], shown: &Shown, bench: Option<&Bench>) -> Markup {
    let scenes = scenes(run);
    let subjects = subjects(run);
    // What a reader looks for comes first.
    let order = match shown.headline.ideal() {
        Ideal::Highest => "descending",
        Ideal::Lowest | Ideal::Target(_) => "ascending",
    };
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("{} of every case", shown.title)) {
            table.sortable data-first=(order) {
                caption { (shown.headline.name()) " of every case" }
                thead {
                    tr {
                        th scope="col" { button { "filter" } }
                        @for scene in &scenes { th scope="col" { button { (scene) } } }
                        th scope="col" { button { "cost, ms" } }
                    }
                }
                @for alignment in alignments(&subjects) {
                    tbody.group {
                        tr { th scope="rowgroup" colspan=(scenes.len() + 2) { (alignment) " shutter" } }
                    }
                    tbody {
                    @for subject in subjects.iter().filter(|subject| subject.alignment == *alignment) {
                        tr.bar[subject.bar] {
                            th scope="row" { (subject.name) }
                            @for scene in &scenes {
                                @match case_of(run, subject, scene) {
                                    Some(index) => (cell(shown, &pages[index])),
                                    None => td { "-" },
                                }
                            }
                            (cost(cost_of(run, bench, subject)))
                        }
                    }
                    }
                }
            }
        }
    }
}

/// Sorts as the scores do.
fn cost(cost: Option<&CaseCost>) -> Markup {
    html! {
        td.cost data-value=[cost.map(|cost| cost.seconds.median)] { (cost_text(cost)) }
    }
}

/// What signs and colours mean.
fn key() -> Markup {
    html! {
        p.key {
            span.kept { "✓ kept" } " " span.broken { "✗ broken" } " "
            span.broken.required { "✗ broken, and a check fails" } " "
            span.inconclusive { "? the noise does not tell" } " "
            span.undecided { "~ limit stricter than the noise allows" }
            " The stronger the colour, the farther from the limit; no colour: no bound. Names in italics are bars to measure \
             filters by. Costs are those of the last section; \"-\" was not timed. Numbers lead to their case; the headings sort."
        }
    }
}
