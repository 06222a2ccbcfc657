//! The best filters of every shutter.

use judge::{
    RANKED_BY, RankedFilter, inseparable_text, no_gain_text, rank_for_summary, rank_sequences,
};
use maud::{Markup, html};
use measure::{FilterId, Run};
use metrics::Metric;

use crate::address::{case_anchor, section_anchor};
use crate::case_table::CaseTable;
use crate::sequence::SEQUENCES_PAGE;

/// Names the best filters of every shutter, the first one's weakest scene, and the last filter of
/// the ranking.
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
                    (first_rank(group, "Best", "FLIP", number, link, weakest))
                    @let last = group.iter().rfind(|filter| filter.is_ranked());
                    @if let Some(last) = last.filter(|last| !last.may_be_best()) {
                        "; worst: " (link(last)) " (" (number(last.mean)) ")"
                    }
                    "."
                    (behind_all(group))
                }
            }
        }
        @if let Some(text) = inseparable_text(table.run) { p.note { (text) } }
    }
}

/// Names the filters that rank behind all others because they change what stands still; nothing if
/// none does.
fn behind_all(group: &[RankedFilter]) -> Markup {
    let ruining = group
        .iter()
        .filter(|filter| filter.side_effects.ruins_still());
    let names: Vec<String> = ruining
        .map(|filter| format!("{} ({})", filter.name, filter.side_effects.texts()[0]))
        .collect();
    html! {
        @if !names.is_empty() {
            " Behind all others, because they change what stands still: " (names.join(", ")) "."
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
                    @let ranked: Vec<RankedFilter> = group.iter().map(|sequence| sequence.ranked.clone()).collect();
                    li { (first_rank(&ranked, "Best sequences", "JOD", number, name, scene)) "." }
                }
            }
            p.note {
                "Sequences are ranked by JOD: " (RANKED_BY.row().meaning) ". " code { (SEQUENCES_PAGE) } " next to run.json shows all of their scores."
            }
        }
    }
}

/// Names the filters that share the first rank, and the first one's weakest scene. If no filter is
/// better than no blur, says that first.
fn first_rank(
    group: &[RankedFilter],
    title: &str,
    score: &str,
    number: impl Fn(f64) -> String,
    name: impl Fn(&RankedFilter) -> Markup,
    weakest: impl Fn(&RankedFilter) -> Markup,
) -> Markup {
    let mut first = group.iter().filter(|filter| filter.may_be_best());
    let best = first.next();
    let no_gain = no_gain_text(group);
    let RankedFilter {
        alignment, rate, ..
    } = &group[0];
    html! {
        (if no_gain.is_some() { "With a " } else { title }) @if no_gain.is_none() { " with a " }
        (alignment) " shutter" @if let Some(rate) = rate { " at " (rate.text()) }
        @if let Some(text) = no_gain { " " strong { (text) } }
        @if let Some(best) = best {
            (if no_gain.is_some() { "; first: " } else { ": " })
            strong { (name(best)) } ", " (score) " " strong { (number(best.mean)) }
            @if let Some([low, high]) = best.interval { " (95 % CI " (number(low)) " to " (number(high)) ")" }
            "; weakest on " (weakest(best)) " (" (number(best.worst.1)) ")"
        }
        @for (index, filter) in first.enumerate() {
            (if index == 0 { "; too close to tell apart: " } else { ", " }) (name(filter)) " (" (number(filter.mean)) ")"
        }
    }
}
