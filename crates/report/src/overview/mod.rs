//! Overview: all scenes and all filters at a glance.

mod cell;
pub mod costs;
mod headlines;
mod pareto;
mod score_table;

use maud::{Markup, html};

use crate::case::bounds::broken_bounds;
use crate::case::case_view::CaseView;
use crate::filter_id::{FilterId, case_anchor, list_filters, list_scenes};
use crate::run_facts::provenance;
use costs::costs;
use headlines::{TABLE_SCORES, TableScore};
use score_table::{Row, rank_rows, score_table};
use suite::{Bench, Headline, Level, Outcome, Run};

/// Shows the scores of all cases, costs, and what the run depended on. `thumbnails` are addresses of the scenes' truths.
pub fn overview(
    run: &Run,
    views: &[CaseView],
    thumbnails: &[String],
    bench: Option<&Bench>,
) -> Markup {
    html! {
        section #overview {
            (outcome(views))
            (winners(run))
            (broken_bounds(views))
            div.toolbar #tables {
                fieldset.choice {
                    legend.unseen { "Score" }
                    @for (index, score) in TABLE_SCORES.iter().enumerate() {
                        label {
                            input type="radio" name="metric" value=(score.headline.name()) checked[index == 0];
                            span { (score.title) }
                        }
                    }
                }
                input type="search" name="search" placeholder="Search filters" aria-label="Search filters";
                @if views.iter().any(|view| !view.findings.is_empty()) {
                    label.check { input type="checkbox" name="failing"; " Only failing" }
                }
                label.check { input type="checkbox" name="references"; " References" }
            }
            @for score in &TABLE_SCORES { (panel(run, views, thumbnails, score, bench)) }
            (key())
            div.peek hidden aria-hidden="true" {
                @for title in ["truth", "output", "FLIP"] { figure { canvas width="48" height="48" {} figcaption { (title) } } }
            }
            (costs(run, bench))
            (provenance(run))
        }
    }
}

/// Counts scenes and filters, and says whether a check passes.
fn outcome(views: &[CaseView]) -> Markup {
    let findings = || views.iter().flat_map(|view| &view.findings);
    let count = |level, outcome| {
        findings()
            .filter(|own| own.level == level && own.outcome == outcome)
            .count()
    };
    let required = findings()
        .filter(|own| own.level == Level::Required)
        .count();
    let broken = count(Level::Required, Outcome::Broken);
    let open =
        count(Level::Required, Outcome::Inconclusive) + count(Level::Required, Outcome::TooNoisy);
    let (class, word) = match (broken, open) {
        (0, 0) => ("kept", "PASS"),
        (0, _) => ("undecided", "UNDECIDED"),
        (_, _) => ("broken", "FAIL"),
    };
    let targets = findings().filter(|own| own.level == Level::Report).count();
    html! {
        @if required + targets > 0 {
            p.outcome {
                @if required > 0 {
                    strong class=(class) { (word) } " "
                    (counted(required, "required bound")) ": " (broken) " broken, " (open) " too noisy to decide. "
                }
                @if targets > 0 {
                    (counted(targets, "target")) ", which fail nothing: " (count(Level::Report, Outcome::Broken)) " missed."
                }
            }
        }
    }
}

/// Names the best filter of every shutter, and the scene that it is weakest on.
fn winners(run: &Run) -> Markup {
    let groups = rank_rows(run, Headline::FLIP);
    html! {
        ul.winners {
            @for group in &groups {
                @let own: Vec<&Row> = group.iter().filter(|row| !row.filter.is_reference && row.mean.is_some()).collect();
                @if let Some(best) = own.first() { (winner(run, best, &own)) }
            }
        }
        p.note {
            (counted(list_scenes(run).len(), "scene")) ", "
            (counted(list_filters(run).iter().filter(|own| !own.is_reference).count(), "filter preset")) ". "
            "FLIP is the visible difference from the truth where anything moves; low is good. "
            "Click a score to see the pictures."
        }
    }
}

fn winner(run: &Run, best: &Row, group: &[&Row]) -> Markup {
    let text = |row: &Row| Headline::FLIP.number(row.mean.unwrap_or_default());
    let ties: Vec<&&Row> = group.iter().filter(|row| text(row) == text(best)).collect();
    let flip = |index: usize| Headline::FLIP.measured(&run.cases[index]).value();
    let cases = best
        .filter
        .cases(run)
        .filter_map(|(index, _)| Some((index, flip(index)?)));
    let worst = cases.max_by(|a, b| a.1.total_cmp(&b.1));
    html! {
        li {
            "Best with a " (best.filter.alignment) " shutter: "
            @for (index, row) in ties.iter().enumerate() {
                @if index > 0 { " = " }
                a href=(format!("#{}", row.filter.section_anchor())) { strong { (row.filter.name) } }
            }
            ", FLIP " strong { (text(best)) }
            @if let Some(own) = best.overall {
                @let [low, high] = own.interval.map(|end| Headline::FLIP.number(end));
                " (95 % CI " (low) " to " (high) ")"
            }
            @if let Some((index, error)) = worst {
                "; weakest on " a href=(format!("#{}", case_anchor(&run.cases[index]))) { (run.cases[index].scene) }
                " (" (Headline::FLIP.number(error)) ")"
            }
            @if group.len() > ties.len() { (last(group[group.len() - 1], &text)) }
            "."
        }
    }
}

fn last(row: &Row, text: &impl Fn(&Row) -> String) -> Markup {
    let FilterId { name, .. } = &row.filter;
    html! { "; last of the shutter: " a href=(format!("#{}", row.filter.section_anchor())) { (name) } " (" (text(row)) ")" }
}

/// Writes `1 scene`, `2 scenes`.
fn counted(count: usize, noun: &str) -> String {
    match count {
        1 => format!("1 {noun}"),
        count => format!("{count} {noun}s"),
    }
}

fn panel(
    run: &Run,
    views: &[CaseView],
    thumbnails: &[String],
    score: &TableScore,
    bench: Option<&Bench>,
) -> Markup {
    // One copy of the pictures is enough: the script moves them to the table that is seen.
    let first = score.headline == TABLE_SCORES[0].headline;
    let none = vec![String::new(); thumbnails.len()];
    html! {
        div.panel data-metric=(score.headline.name()) {
            p.meaning { strong { (score.title) } ": " (score.meaning()) "; " (score.better()) "." }
            (score_table(run, views, if first { thumbnails } else { &none }, score, bench))
        }
    }
}

/// Explains signs and colours.
fn key() -> Markup {
    html! {
        p.key {
            span.good style="--strength:80%" { "good" } " " span.bad style="--strength:80%" { "bad" }
            " against all scores of the table. ✓ bound kept, ✗ broken, ? too noisy to decide, ~ limit stricter than the noise allows; "
            span.required { "✗ fails a check" }
            ". Open marks and italics: references. Arrows lie beyond the scale. Headings sort."
        }
    }
}
