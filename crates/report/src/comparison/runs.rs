//! Settings of two runs side by side.

use std::collections::HashSet;

use frame::Alignment;
use maud::{Markup, html};
use measure::{Case, Run, StoredRun};
use scene::SceneId;

use crate::run_facts::facts;
use crate::table::Column::{Plain, Text};
use crate::table::scroll_table;

/// Lists the settings of both runs, and their common truths.
pub fn both_runs(first: &StoredRun, second: &StoredRun) -> Markup {
    let rows = facts(&first.run).into_iter().zip(facts(&second.run));
    let settings = html! {
        tr {
            th scope="row" { "file" }
            td.text { (first.path.display()) }
            td.text { (second.path.display()) }
        }
        @for ((name, first), (_, second)) in rows {
            tr { th scope="row" { (name) } td.text { (first) } td.text { (second) } }
        }
    };
    let hashes = html! {
        @for (scene, alignment, hash) in truths(&first.run, &second.run) {
            tr { th scope="row" { (scene) } td.text { (alignment) } td.text { code { (hash) } } }
        }
    };
    html! {
        section.provenance {
            h2 { "Provenance" }
            (scroll_table(Some("wide"), "Settings of both runs", None, &[
                Plain(""), Text("first"), Text("second"),
            ], &settings))
            (scroll_table(Some("stacked"), "Truths", Some("Truths, which both runs share"), &[
                Plain("scene"), Text("shutter"), Text("hash of the truth"),
            ], &hashes))
        }
    }
}

/// Lists scene, alignment and hash of the common truths, each once.
fn truths<'a>(first: &'a Run, second: &'a Run) -> Vec<(&'a SceneId, Alignment, &'a str)> {
    let list = |run: &'a Run| {
        let truth = |case: &'a Case| (&case.scene, case.alignment, case.truth_hash.as_str());
        run.cases.iter().map(truth)
    };
    let others: HashSet<_> = list(second).collect();
    let mut seen = HashSet::new();
    list(first)
        .filter(|truth| others.contains(truth) && seen.insert(*truth))
        .collect()
}
