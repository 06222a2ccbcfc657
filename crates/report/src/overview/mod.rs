//! Overview: all scenes and all filters at a glance.

mod cell;
pub mod costs;
mod headlines;
mod pareto;
mod score_table;
mod sequences;

use maud::{Markup, html};
use metrics::Metric;

use crate::case::bounds::broken_bounds;
use crate::case::case_view::CaseView;
use crate::case_table::CaseTable;
use crate::filter_id::{case_anchor, section_anchor};
use crate::numbers::counted;
use crate::pixels::scene_files::find_traced;
use crate::run_facts::provenance;
use costs::costs;
use headlines::{TABLE_SCORES, TableScore};
use score_table::score_table;
use sequences::sequence_winners;
use suite::{Bench, FilterId, Finding, Level, Outcome, RankedFilter, lag_text, rank_for_summary};
use tracer::SceneId;

/// Shows the scores of all cases, costs, and what the run depended on. `thumbnails` are addresses of the scenes' truths.
pub fn overview(
    table: &CaseTable,
    views: &[CaseView],
    thumbnails: &[String],
    bench: Option<&Bench>,
) -> Markup {
    html! {
        section #overview {
            (outcome(views))
            (winners(table))
            (sequence_winners(table.run))
            (counts(table, views))
            (engines(table))
            @if let Some(note) = table.run.scaling_note() { p.note { (note) } }
            (broken_bounds(views))
            div.toolbar #tables {
                fieldset.choice {
                    legend.unseen { "Score" }
                    @for (index, score) in TABLE_SCORES.iter().enumerate() {
                        label {
                            input type="radio" name="metric" value=(score.metric.name()) checked[index == 0];
                            span { (score.title) }
                        }
                    }
                }
                input type="search" name="search" placeholder="Search filters" aria-label="Search filters";
                @if is_checked(views) {
                    label.check { input type="checkbox" name="failing"; " Only failing" }
                }
                label.check { input type="checkbox" name="references"; " References" }
            }
            @for score in &TABLE_SCORES { (panel(table, views, thumbnails, score, bench)) }
            p.nothing hidden { "No filter of this name." }
            (key(is_checked(views)))
            div.peek hidden aria-hidden="true" {
                p {}
                @for title in ["truth", "output", "FLIP"] { figure { canvas width="48" height="48" {} figcaption { (title) } } }
            }
            (costs(table, bench))
            (provenance(table))
        }
    }
}

/// Lists the findings about bounds of one level.
fn findings_of<'a>(views: &'a [CaseView<'a>], level: Level) -> impl Iterator<Item = &'a Finding> {
    let all = views.iter().flat_map(|view| &view.findings);
    all.filter(move |finding| finding.level == level)
}

/// Tells whether any bound is required: a check's are, a run's are targets.
fn is_checked(views: &[CaseView]) -> bool {
    findings_of(views, Level::Required).next().is_some()
}

/// Says whether a check passes; nothing where no bound is required.
fn outcome(views: &[CaseView]) -> Markup {
    let count = |is_counted: fn(Outcome) -> bool| {
        findings_of(views, Level::Required)
            .filter(|finding| is_counted(finding.outcome))
            .count()
    };
    let required = count(|_| true);
    let broken = count(|own| own == Outcome::Broken);
    let open = count(|own| matches!(own, Outcome::Inconclusive | Outcome::TooNoisy));
    let (class, word) = match (broken, open) {
        (0, 0) => ("kept", "PASS"),
        (0, _) => ("undecided", "UNDECIDED"),
        (_, _) => ("broken", "FAIL"),
    };
    html! {
        @if required > 0 {
            p.outcome {
                strong class=(class) { (word) } " "
                (counted(required, "required bound")) ": " (broken) " broken, " (open) " too noisy to decide."
            }
        }
    }
}

/// Counts scenes, filters and missed targets.
fn counts(table: &CaseTable, views: &[CaseView]) -> Markup {
    let filters = table.filters.iter().filter(|own| !own.is_reference).count();
    let targets = findings_of(views, Level::Report).count();
    let missed = findings_of(views, Level::Report).filter(|own| own.outcome == Outcome::Broken);
    html! {
        p.note {
            (counted(table.scenes.len(), "scene")) ", " (counted(filters, "filter preset")) ". "
            "Click a score to see the pictures."
            @if targets > 0 { " " (missed.count()) " of " (counted(targets, "target")) " missed; targets fail nothing." }
        }
    }
}

/// Says which scenes an engine drew, and whose truth is whose.
fn engines(table: &CaseTable) -> Markup {
    let first = |scene: &&SceneId| table.cases_on(scene).next();
    let cases = table.scenes.iter().filter_map(first);
    html! {
        @for (case, drawn) in cases.filter_map(|(_, case)| Some((case, case.drawn.as_ref()?))) {
            p.note {
                strong { (case.scene) } ": frame and truth are not ours. The truth is the " (drawn.truth_text()) "."
                @if let Some(traced) = find_traced(table.run, case) {
                    " Ours is that of " strong { (traced.scene) } ", path traced; the pictures of both stand side by side."
                }
            }
        }
    }
}

/// Names the best filter of every shutter, and the scene that it is weakest on.
fn winners(table: &CaseTable) -> Markup {
    html! {
        ul.winners {
            @for group in &rank_for_summary(&table.run.cases) { (winner(table, group)) }
        }
    }
}

/// Names the filters that share the first rank, and the last filter of the ranking.
fn winner(table: &CaseTable, group: &[RankedFilter]) -> Markup {
    let best = &group[0];
    let ties: Vec<&RankedFilter> = group[1..].iter().filter(|own| own.ranks[0] == 1).collect();
    let number = |value: f64| Metric::FLIP.number(value);
    let (scene, error) = &best.worst;
    let weakest = table.case_on(&id_of(best), scene);
    html! {
        li {
            "Best with a " (best.alignment) " shutter" @if let Some(rate) = best.rate { " at " (rate.text()) } ": " strong { (link(best)) } ", FLIP " strong { (number(best.mean)) }
            @if let Some([low, high]) = best.interval { " (95 % CI " (number(low)) " to " (number(high)) ")" }
            @if let Some(index) = weakest {
                "; weakest on " a href=(format!("#{}", case_anchor(&table.run.cases[index]))) { (scene) } " (" (number(*error)) ")"
            }
            @for (index, own) in ties.iter().enumerate() {
                (if index == 0 { "; too close to tell apart: " } else { ", " }) (link(own)) " (" (number(own.mean)) ")"
            }
            @if let Some(last) = group.last().filter(|own| own.ranks[0] > 1) {
                "; worst: " (link(last)) " (" (number(last.mean)) ")"
            }
            "."
        }
    }
}

fn id_of(ranked: &RankedFilter) -> FilterId {
    FilterId {
        name: ranked.name.clone(),
        is_reference: false,
        alignment: ranked.alignment,
    }
}

/// Links a filter to its section.
fn link(ranked: &RankedFilter) -> Markup {
    html! { a href=(format!("#{}", section_anchor(&id_of(ranked)))) { (ranked.name) } }
}

fn panel(
    table: &CaseTable,
    views: &[CaseView],
    thumbnails: &[String],
    score: &TableScore,
    bench: Option<&Bench>,
) -> Markup {
    // One copy of the pictures is enough: the script moves them to the table that is seen.
    let first = score.metric == TABLE_SCORES[0].metric;
    let none = vec![String::new(); thumbnails.len()];
    let content = html! {
        p.meaning {
            strong { (score.title) } ": " (score.metric.meaning()) "; " (score.better()) "."
            @if let Some(lag) = lag_text(&table.run.cases).filter(|_| score.metric == Metric::SKILL) { " " (lag) }
        }
        (score_table(table, views, if first { thumbnails } else { &none }, score, bench))
    };
    html! {
        div.panel data-metric=(score.metric.name()) {
            // Where scripts run, the other tables are text until somebody looks at them, so that the page opens sooner.
            @if first { (content) } @else { noscript { (content) } }
        }
    }
}

/// Explains signs and colours; `is_checked` tells whether any bound is required.
fn key(is_checked: bool) -> Markup {
    html! {
        p.key {
            span.good style="--strength:80%" { "good" } " " span.bad style="--strength:80%" { "bad" }
            " compared with all scores of the table. "
            @if is_checked {
                "✓ bound kept; ? too noisy to decide; ~ limit stricter than the noise allows; " span.required { "✗ bound broken" } " "
            }
            "Italics and open marks: references. Arrows: beyond the scale. Click a heading to sort."
        }
    }
}
