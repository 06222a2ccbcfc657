//! Overview: all scenes and all filters at a glance.

mod cell;
pub mod costs;
mod headlines;
mod pareto;
mod score_table;

use maud::{Markup, html};

use crate::case::bounds::broken_bounds;
use crate::case::case_view::CaseView;
use crate::case_score::estimate_of;
use crate::filter_id::{FilterId, case_anchor, list_filters, list_scenes};
use crate::numbers::counted;
use crate::run_facts::provenance;
use costs::costs;
use headlines::{TABLE_SCORES, TableScore};
use score_table::{Row, rank_rows, score_table};
use suite::{Bench, Finding, Headline, Level, Outcome, Run};

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
            (counts(run, views))
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
                @if is_checked(views) {
                    label.check { input type="checkbox" name="failing"; " Only failing" }
                }
                label.check { input type="checkbox" name="references"; " References" }
            }
            @for score in &TABLE_SCORES { (panel(run, views, thumbnails, score, bench)) }
            p.nothing hidden { "No filter of this name." }
            (key(is_checked(views)))
            div.peek hidden aria-hidden="true" {
                p {}
                @for title in ["truth", "output", "FLIP"] { figure { canvas width="48" height="48" {} figcaption { (title) } } }
            }
            (costs(run, bench))
            (provenance(run))
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
fn counts(run: &Run, views: &[CaseView]) -> Markup {
    let filters = list_filters(run);
    let filters = filters.iter().filter(|own| !own.is_reference).count();
    let targets = findings_of(views, Level::Report).count();
    let missed = findings_of(views, Level::Report).filter(|own| own.outcome == Outcome::Broken);
    html! {
        p.note {
            (counted(list_scenes(run).len(), "scene")) ", " (counted(filters, "filter preset")) ". "
            "Click a score to see the pictures."
            @if targets > 0 { " " (missed.count()) " of " (counted(targets, "target")) " missed; targets fail nothing." }
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
    }
}

fn winner(run: &Run, best: &Row, group: &[&Row]) -> Markup {
    let text = |row: &Row| Headline::FLIP.number(row.mean.unwrap_or_default());
    let ties: Vec<&&Row> = group.iter().filter(|row| text(row) == text(best)).collect();
    let cases = best.filter.cases(run);
    let cases = cases.filter_map(|(index, case)| Some((index, estimate_of(case, Headline::FLIP)?)));
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
    html! { "; worst: " a href=(format!("#{}", row.filter.section_anchor())) { (name) } " (" (text(row)) ")" }
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
