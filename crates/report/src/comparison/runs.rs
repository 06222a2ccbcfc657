//! Settings of two runs side by side.

use frame::Alignment;
use maud::{Markup, html};

use crate::run_facts::facts;
use suite::Run;
use suite::Side;
use tracer::SceneId;

/// Lists the settings of both runs, and the truths that they share.
pub fn both_runs(first: &Side, second: &Side) -> Markup {
    let rows = facts(&first.run).into_iter().zip(facts(&second.run));
    html! {
        section.provenance {
            h2 { "Provenance" }
            div.scroll tabindex="0" role="region" aria-label="Both runs" {
                table.wide {
                    caption.unseen { "Settings of both runs" }
                    thead {
                        tr { th scope="col" {} th.text scope="col" { "first" } th.text scope="col" { "second" } }
                    }
                    tbody {
                        tr {
                            th scope="row" { "file" }
                            td.text { (first.path.display()) }
                            td.text { (second.path.display()) }
                        }
                        @for ((name, first), (_, second)) in rows {
                            tr { th scope="row" { (name) } td.text { (first) } td.text { (second) } }
                        }
                    }
                }
            }
            div.scroll tabindex="0" role="region" aria-label="Truths" {
                table.stacked {
                    caption { "Truths, which both runs share" }
                    thead {
                        tr {
                            th scope="col" { "scene" }
                            th.text scope="col" { "shutter" }
                            th.text scope="col" { "hash of the truth" }
                        }
                    }
                    tbody {
                        @for (scene, alignment, hash) in truths(&first.run, &second.run) {
                            tr { th scope="row" { (scene) } td.text { (alignment) } td.text { code { (hash) } } }
                        }
                    }
                }
            }
        }
    }
}

/// Scene, alignment and hash of what both have, each once.
fn truths<'a>(first: &'a Run, second: &Run) -> Vec<(&'a SceneId, Alignment, &'a str)> {
    let mut truths = Vec::new();
    for case in &first.cases {
        let shared = second
            .cases
            .iter()
            .any(|own| own.scene == case.scene && own.truth_hash == case.truth_hash);
        let truth = (&case.scene, case.alignment, case.truth_hash.as_str());
        if shared && !truths.contains(&truth) {
            truths.push(truth);
        }
    }
    truths
}
