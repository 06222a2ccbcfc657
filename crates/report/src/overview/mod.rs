//! Overview: all scenes and all filters at a glance.

mod cell;
pub mod costs;
mod pareto;
mod ranking;
mod score_tables;

use maud::{Markup, html};
use metrics::Ideal;

use crate::case::bounds::broken_bounds;
use crate::case::case_view::CaseView;
use crate::filter_id::{list_alignments, list_filters, list_scenes};
use crate::run_facts::provenance;
use cell::cell;
use costs::{cost_of, cost_text, costs};
use ranking::ranking;
use score_tables::{SCORE_TABLES, ScoreTable};
use suite::CaseCost;
use suite::Outcome;
use suite::{Bench, Run};

/// Shows the scores of all cases, costs, and what the run depended on.
pub fn overview(run: &Run, pages: &[CaseView], bench: Option<&Bench>) -> Markup {
    html! {
        section #overview {
            p.lead { (summary(run, pages)) }
            (broken_bounds(pages))
            fieldset.choice #metrics {
                legend { "Score" }
                @for (index, table) in SCORE_TABLES.iter().enumerate() {
                    label {
                        input type="radio" name="metric" value=(table.headline.name()) checked[index == 0];
                        span { (table.title) }
                    }
                }
            }
            @for table in &SCORE_TABLES { (panel(run, pages, table, bench)) }
            (key())
            (costs(run, bench))
            (provenance(run))
        }
    }
}

/// `5 scenes, 23 filters; 230 bounds: 180 kept, 50 broken`
fn summary(run: &Run, pages: &[CaseView]) -> String {
    let all = list_filters(run);
    let filters = all.iter().filter(|own| !own.is_reference).count();
    let mut text = format!(
        "{} and {}, beside {}.",
        counted(list_scenes(run).len(), "scene"),
        counted(filters, "filter preset"),
        counted(all.len() - filters, "reference"),
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

fn panel(run: &Run, pages: &[CaseView], score: &ScoreTable, bench: Option<&Bench>) -> Markup {
    html! {
        div.panel data-metric=(score.headline.name()) {
            h2 { (score.title) }
            p { (score.meaning()) "; " (score.better()) "." }
            (ranking(run, score, bench))
            (table(run, pages, score, bench))
        }
    }
}

/// One row per filter preset or reference, those of one shutter together; one column per scene.
fn table(run: &Run, pages: &[CaseView], score: &ScoreTable, bench: Option<&Bench>) -> Markup {
    let scenes = list_scenes(run);
    let filters = list_filters(run);
    // What a reader looks for comes first.
    let order = match score.headline.ideal() {
        Ideal::Highest => "descending",
        Ideal::Lowest | Ideal::Target(_) => "ascending",
    };
    html! {
        div.scroll tabindex="0" role="region" aria-label=(format!("{} of every case", score.title)) {
            table.sortable data-first=(order) {
                caption { (score.headline.name()) " of every case" }
                thead {
                    tr {
                        th scope="col" { button { "filter" } }
                        @for scene in &scenes { th scope="col" { button { (scene) } } }
                        th scope="col" { button { "cost, ms" } }
                    }
                }
                @for alignment in list_alignments(&filters) {
                    tbody.group {
                        tr { th scope="rowgroup" colspan=(scenes.len() + 2) { (alignment) " shutter" } }
                    }
                    tbody {
                    @for filter in filters.iter().filter(|own| own.alignment == *alignment) {
                        tr.reference[filter.is_reference] {
                            th scope="row" { (filter.name) }
                            @for scene in &scenes {
                                @match filter.case_on(run, scene) {
                                    Some(index) => (cell(score, &pages[index])),
                                    None => td { "-" },
                                }
                            }
                            (cost(cost_of(run, bench, filter)))
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
            span.inconclusive { "? too noisy to decide" } " "
            span.undecided { "~ limit stricter than the noise allows" }
            " The stronger the colour, the farther from the limit; no colour: no bound. Names in italics are references. Costs are those of the last section; \"-\" was not timed. Numbers lead to their case; the headings sort."
        }
    }
}
