//! Settings that a tuning ran with.

use maud::{Markup, html};
use tune::JournalHeader;

/// Lists all that the trials depended on, and the hashes of the truths.
pub fn settings(header: &JournalHeader) -> Markup {
    let limit = |limit: Option<f64>| {
        limit.map_or_else(
            || "none".to_owned(),
            |limit| format!("{limit} times the start's"),
        )
    };
    let facts = [
        ("program", header.program.clone()),
        ("filter", format!("{}:{}", header.filter, header.start)),
        ("measured", header.objectives.join(", ")),
        ("cost at most", limit(header.cost_at_most)),
        ("lateral bleed at most", limit(header.bleed_at_most)),
        (
            "racing",
            if header.race {
                "clearly worse candidates are dropped"
            } else {
                "none"
            }
            .to_owned(),
        ),
        ("seed of the search", header.seed.to_string()),
    ];
    html! {
        section.provenance {
            h2 { "Provenance" }
            dl {
                @for (term, text) in facts { div { dt { (term) } dd { (text) } } }
                @for (name, value) in &header.values {
                    @if !header.vary.contains_key(name) { div { dt { (name) } dd { (value) ", not varied" } } }
                }
            }
            div.scroll tabindex="0" role="region" aria-label="Scenes" {
                table.stacked {
                    caption { "Scenes in the order in which candidates meet them" }
                    thead { tr { th scope="col" { "scene" } th.text scope="col" { "hash of the truth" } } }
                    tbody {
                        @for (scene, hash) in &header.scenes { tr { th scope="row" { (scene) } td.text { code { (hash) } } } }
                    }
                }
            }
        }
    }
}
