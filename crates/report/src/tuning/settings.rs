//! Settings that a tuning ran with.

use maud::{Markup, html};
use tune::JournalHeader;

use crate::table::Column::{Plain, Text};
use crate::table::scroll_table;

/// Lists all that the trials depended on, and the hashes of the truths.
pub fn settings(header: &JournalHeader) -> Markup {
    let limit = |limit: Option<f64>| match limit {
        Some(limit) => format!("{limit} times the start's"),
        None => "none".to_owned(),
    };
    let racing = match header.race {
        true => "clearly worse candidates are dropped",
        false => "none",
    };
    let measured: Vec<&str> = header.objectives.iter().map(|it| it.name()).collect();
    let facts = [
        ("program", header.program.clone()),
        ("filter", format!("{}:{}", header.filter, header.start)),
        ("measured", measured.join(", ")),
        ("cost at most", limit(header.cost_at_most)),
        ("lateral bleed at most", limit(header.bleed_at_most)),
        ("racing", racing.to_owned()),
        ("seed of the search", header.seed.to_string()),
    ];
    let scenes = html! {
        @for (scene, hash) in &header.scenes { tr { th scope="row" { (scene) } td.text { code { (hash) } } } }
    };
    html! {
        section.provenance {
            h2 { "Provenance" }
            dl {
                @for (term, text) in facts { div { dt { (term) } dd { (text) } } }
                @for (name, value) in &header.values {
                    @if !header.vary.contains_key(name) { div { dt { (name) } dd { (value) ", not varied" } } }
                }
            }
            (scroll_table(Some("stacked"), "Scenes", Some("Scenes in the order in which candidates meet them"), &[
                Plain("scene"), Text("hash of the truth"),
            ], &scenes))
        }
    }
}
