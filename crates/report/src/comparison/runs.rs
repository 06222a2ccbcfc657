//! Settings of two runs side by side.

use judge::Side;
use maud::{Markup, html};
use suite::Run;

use crate::run_facts::facts;
use crate::table::{Column, scroll_table};

/// Lists the settings of both runs, and the truths that they share.
pub fn both_runs(first: &Side, second: &Side) -> Markup {
    let rows = facts(&first.run).into_iter().zip(facts(&second.run));
    let settings = html! {
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
    };
    let hashes = html! {
        tbody {
            @for [scene, alignment, hash] in truths(&first.run, &second.run) {
                tr { th scope="row" { (scene) } td.text { (alignment) } td.text { code { (hash) } } }
            }
        }
    };
    let sides = [
        Column::Plain(""),
        Column::Text("first"),
        Column::Text("second"),
    ];
    let columns = [
        Column::Plain("scene"),
        Column::Text("shutter"),
        Column::Text("hash of the truth"),
    ];
    html! {
        section.provenance {
            h2 { "Provenance" }
            (scroll_table(Some("wide"), "Settings of both runs", None, &sides, &settings))
            (scroll_table(Some("stacked"), "Truths", Some("Truths, which both runs share"), &columns, &hashes))
        }
    }
}

/// Scene, alignment and hash of what both have, each once.
fn truths<'a>(first: &'a Run, second: &Run) -> Vec<[&'a str; 3]> {
    let mut truths = Vec::new();
    for case in &first.cases {
        let shared = second
            .cases
            .iter()
            .any(|own| own.scene == case.scene && own.truth_hash == case.truth_hash);
        let truth = [case.scene.as_str(), case.alignment.name(), &case.truth_hash];
        if shared && !truths.contains(&truth) {
            truths.push(truth);
        }
    }
    truths
}
