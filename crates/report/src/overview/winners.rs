//! The best filters of every shutter.

use judge::{RANKED_BY, RankedFilter, rank_for_summary, rank_sequences};
use maud::{Markup, html};
use metrics::Metric;
use suite::{FilterId, Run};

use crate::address::{case_anchor, section_anchor};
use crate::case_table::CaseTable;
use crate::sequence::SEQUENCES_PAGE;

/// Names the best filters of every shutter, the first one's weakest scene, and the last filter of the ranking.
pub fn winners(table: &CaseTable) -> Markup {
    let number = |value: f64| Metric::FLIP.number(value);
    let id = |ranked: &RankedFilter| FilterId {
        name: ranked.name.clone(),
        is_reference: false,
        alignment: ranked.alignment,
    };
    let link = |ranked: &RankedFilter| {
        html! { a href=(format!("#{}", section_anchor(&id(ranked)))) { (ranked.name) } }
    };
    let weakest = |ranked: &RankedFilter| {
        let (scene, _) = &ranked.worst;
        let case = table.case_on(&id(ranked), scene);
        let address = case.map(|index| format!("#{}", case_anchor(&table.run.cases[index])));
        html! { a href=[address] { (scene) } }
    };
    html! {
        ul.winners {
            @for group in &rank_for_summary(&table.run.cases) {
                li {
                    "Best " (first_rank(group, "FLIP", number, link, weakest))
                    @if let Some(last) = group.last().filter(|own| own.ranks[0] > 1) {
                        "; worst: " (link(last)) " (" (number(last.mean)) ")"
                    }
                    "."
                }
            }
        }
    }
}

/// Names the best filters of the sequences of every shutter; nothing if the run has no sequences.
pub fn sequence_winners(run: &Run) -> Markup {
    let groups = rank_sequences(run);
    let number = |value: f64| RANKED_BY.shown_text(value);
    let name = |ranked: &RankedFilter| html! { (ranked.name) };
    let scene = |ranked: &RankedFilter| html! { (ranked.worst.0) };
    html! {
        @if !groups.is_empty() {
            ul.winners {
                @for group in &groups {
                    @let ranked: Vec<RankedFilter> = group.iter().map(|own| own.ranked.clone()).collect();
                    li { "Best sequences " (first_rank(&ranked, "JOD", number, name, scene)) "." }
                }
            }
            p.note {
                "Sequences are ranked by JOD: " (RANKED_BY.row().meaning) ". " code { (SEQUENCES_PAGE) } " next to run.json shows all of their scores."
            }
        }
    }
}

/// Names the filters that share the first rank, and the first one's weakest scene.
fn first_rank(
    group: &[RankedFilter],
    score: &str,
    number: impl Fn(f64) -> String,
    name: impl Fn(&RankedFilter) -> Markup,
    weakest: impl Fn(&RankedFilter) -> Markup,
) -> Markup {
    let best = &group[0];
    let ties = group[1..].iter().filter(|own| own.ranks[0] == 1);
    html! {
        "with a " (best.alignment) " shutter" @if let Some(rate) = best.rate { " at " (rate.text()) }
        ": " strong { (name(best)) } ", " (score) " " strong { (number(best.mean)) }
        @if let Some([low, high]) = best.interval { " (95 % CI " (number(low)) " to " (number(high)) ")" }
        "; weakest on " (weakest(best)) " (" (number(best.worst.1)) ")"
        @for (index, own) in ties.enumerate() {
            (if index == 0 { "; too close to tell apart: " } else { ", " }) (name(own)) " (" (number(own.mean)) ")"
        }
    }
}
