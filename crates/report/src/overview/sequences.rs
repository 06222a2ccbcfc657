//! What a run's sequences say, in a line per shutter.

use judge::{RANKED_BY, RankedFilter, rank_sequences};
use maud::{Markup, html};
use suite::Run;

use crate::sequence::SEQUENCES_PAGE;

/// Names the best filters of the sequences of every shutter; nothing where the run has no sequences.
pub fn sequence_winners(run: &Run) -> Markup {
    let groups = rank_sequences(run);
    html! {
        @if !groups.is_empty() {
            ul.winners {
                @for group in &groups {
                    @let ranked: Vec<&RankedFilter> = group.iter().map(|own| &own.ranked).collect();
                    (winner(&ranked))
                }
            }
            p.note {
                "Sequences are ranked by JOD: " (RANKED_BY.row().meaning) ". " code { (SEQUENCES_PAGE) } " beside run.json shows all of their scores."
            }
        }
    }
}

fn winner(group: &[&RankedFilter]) -> Markup {
    let best = group[0];
    let number = |value: f64| RANKED_BY.shown_text(value);
    let ties = group[1..].iter().filter(|own| own.ranks[0] == 1);
    let (scene, worst) = &best.worst;
    html! {
        li {
            "Best sequences with a " (best.alignment) " shutter" @if let Some(rate) = best.rate { " at " (rate.text()) } ": " strong { (best.name) } ", JOD " strong { (number(best.mean)) }
            @if let Some([low, high]) = best.interval { " (95 % CI " (number(low)) " to " (number(high)) ")" }
            "; weakest on " (scene) " (" (number(*worst)) ")"
            @for (index, own) in ties.enumerate() {
                (if index == 0 { "; too close to tell apart: " } else { ", " }) (own.name) " (" (number(own.mean)) ")"
            }
            "."
        }
    }
}
