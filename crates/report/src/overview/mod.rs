//! Overview: all scenes and all filters at a glance.

mod cell;
mod score_table;
mod winners;

use judge::{Decision, Level, Verdict, lag_text};
use maud::{Markup, html};
use metrics::{Ideal, Metric};
use scene::SceneId;
use score_table::ScoreTable;
use winners::{sequence_winners, winners};

use crate::case::bounds::broken_bounds;
use crate::case_table::CaseTable;
use crate::finding_text::Tally;
use crate::numbers::counted;
use crate::pixels::scene_files::find_traced;
use crate::run_facts::provenance;
use crate::run_view::RunView;

/// Scores with the titles of their tables, in the order of the page.
const TABLE_SCORES: [(Metric, &str); 11] = [
    (Metric::FLIP, "FLIP"),
    (Metric::STILL, "Still"),
    (Metric::GRAIN, "Grain"),
    (Metric::SKILL, "Skill"),
    (Metric::CommonFlip, "FLIP*"),
    (Metric::SUBFRAMES, "N_eq"),
    (Metric::GROWTH, "Growth"),
    (Metric::LOSS, "Loss"),
    (Metric::Bleed, "Bleed"),
    (Metric::LABEL, "Label TV"),
    (Metric::PSNR, "PSNR"),
];

/// Shows the scores of all cases, what other crates add, and what the run depended on.
pub fn overview(view: &RunView) -> Markup {
    let RunView { table, cases, .. } = view;
    let findings = || cases.iter().flat_map(|view| &view.findings);
    let required = Tally::of(findings(), Level::Required);
    let is_checked = required.all > 0;
    html! {
        section #overview {
            @if let Some(verdict) = view.verdict { (outcome(verdict, &required)) }
            (winners(table))
            (sequence_winners(table.run))
            (counts(table))
            (engines(table))
            @if let Some(note) = table.run.scaling_note() { p.note { (note) } }
            (broken_bounds(cases))
            div.toolbar #tables {
                fieldset.choice {
                    legend.unseen { "Score" }
                    @for (index, (metric, title)) in TABLE_SCORES.iter().enumerate() {
                        label {
                            input type="radio" name="metric" value=(metric.name()) checked[index == 0];
                            span { (title) }
                        }
                    }
                }
                input type="search" name="search" placeholder="Search filters" aria-label="Search filters";
                @if is_checked {
                    label.check { input type="checkbox" name="failing"; " Only failing" }
                }
                label.check { input type="checkbox" name="references"; " References" }
            }
            @for (metric, title) in TABLE_SCORES { (panel(view, metric, title)) }
            p.nothing hidden { "No filter of this name." }
            (key(is_checked))
            div.peek hidden aria-hidden="true" {
                p {}
                @for title in ["truth", "output", "FLIP"] { figure { canvas width="48" height="48" {} figcaption { (title) } } }
            }
            @for addition in view.additions { (addition.section) }
            (provenance(table))
        }
    }
}

/// States whether a check passes, and why not.
fn outcome(verdict: &Verdict, required: &Tally) -> Markup {
    let class = match verdict.decision {
        Decision::Pass => "met",
        Decision::Broken => "broken",
        Decision::Inconclusive | Decision::Misconfigured => "undecided",
    };
    html! {
        p.outcome {
            strong class=(class) { (verdict.decision.word()) }
            @if let Some(reason) = &verdict.reason { ": " (reason) "." }
            @if required.all > 0 {
                " " (counted(required.all, "required bound")) ": " (required.broken) " broken, " (required.undecided) " too noisy to decide."
            }
        }
        @if !verdict.comparisons.is_empty() {
            ul { @for line in &verdict.comparisons { li { (line) } } }
        }
    }
}

/// Counts scenes and filters.
fn counts(table: &CaseTable) -> Markup {
    let filters = table
        .filters
        .iter()
        .filter(|filter| !filter.is_reference)
        .count();
    html! {
        p.note {
            (counted(table.scenes.len(), "scene")) ", " (counted(filters, "filter preset")) ". "
            "Click a score to see the pictures."
        }
    }
}

/// Lists the scenes that an engine drew, and whose truths they have.
fn engines(table: &CaseTable) -> Markup {
    let first = |scene: &&SceneId| table.cases_on(scene).next();
    let cases = table.scenes.iter().filter_map(first);
    html! {
        @for (case, drawn) in cases.filter_map(|(_, case)| Some((case, case.drawn.as_ref()?))) {
            p.note {
                strong { (case.scene) } ": frame and truth are not ours. The truth is the " (drawn.truth_text()) "."
                @if let Some(traced) = find_traced(table.run, case) {
                    " Our own, path traced, is " strong { (traced.scene) } "; compare the pictures of both."
                }
            }
        }
    }
}

fn panel(view: &RunView, metric: Metric, title: &str) -> Markup {
    // One copy of the pictures is enough: the script moves them to the visible table.
    let is_first = metric == TABLE_SCORES[0].0;
    let scores = ScoreTable {
        view,
        metric,
        title,
        thumbnails: if is_first { view.thumbnails } else { &[] },
    };
    let content = html! {
        p.meaning {
            strong { (title) } ": " (metric.meaning()) "; " (better(metric)) "."
            @if let Some(lag) = lag_text(&view.table.run.cases).filter(|_| metric == Metric::SKILL) { " " (lag) }
        }
        (scores.write())
    };
    html! {
        div.panel data-metric=(metric.name()) {
            // If scripts run, the other tables are text until somebody looks at them, so that the
            // page opens sooner.
            @if is_first { (content) } @else { noscript { (content) } }
        }
    }
}

/// Explains signs and colours; `is_checked` if any bound is required.
fn key(is_checked: bool) -> Markup {
    html! {
        p.key {
            span.good style="--strength:80%" { "good" } " " span.bad style="--strength:80%" { "bad" }
            " compared with all scores of the table. "
            @if is_checked {
                "✓ bound met; ? too noisy to decide; ~ limit stricter than the noise allows; " span.required { "✗ bound broken" } " "
            }
            "Italics and open marks: references. Arrows: beyond the scale. Click a heading to sort."
        }
    }
}

/// Describes good values.
fn better(metric: Metric) -> String {
    match metric.ideal() {
        Ideal::Lowest => "low is good".to_owned(),
        Ideal::Highest => "high is good".to_owned(),
        Ideal::Target(target) => format!("{target} is good"),
    }
}
