//! Page of a tuning: its choice, its trials, and how far to trust them.

mod choice;
mod folder;
mod parameters;
mod scenes;
mod trials;

use std::path::Path;

use folder::TuneFolder;
use maud::{Markup, html};
use report::FolderPage;
use report::document::{Document, Siblings};
use report::table::Column::{Plain, Text};
use report::table::scroll_table;

use crate::trial::JournalHeader;
use crate::tuning::Tuning;

/// The page of a folder that `tune` wrote.
pub const TUNING_PAGE: FolderPage = FolderPage {
    kind: "tuning",
    find: find_folder,
    make: |folder| Ok(write_page(&TuneFolder::read(folder)?)),
};

/// Finds the folder of a tuning by the names of the files that `run` and `tune search` write.
fn find_folder(path: &Path) -> Option<&Path> {
    let file = path.file_name().unwrap_or_default();
    if path.is_dir() {
        Some(path).filter(|folder| !folder.join("run.json").is_file())
    } else if file == "tune.json" || file == "sensitivity.json" {
        path.parent()
    } else {
        None
    }
}

/// Writes the page. The same folder makes the same bytes.
fn write_page(folder: &TuneFolder) -> String {
    let body = html! {
        @if let Some(tuning) = &folder.tuning { (choice::summary(tuning)) }
        @if let Some(tuning) = &folder.tuning { (choice::values(tuning)) }
        @if !folder.trials.is_empty() {
            (trials::front_section(folder))
            (trials::convergence(&folder.trials))
        }
        @if let Some(tuning) = &folder.tuning {
            (scenes::folds(&tuning.folds))
            (scenes::tuned_on(tuning))
            (scenes::held_out(&tuning.held_out))
        }
        @if let Some(sensitivity) = &folder.sensitivity { (parameters::importance(sensitivity)) }
        (parameters::slices(folder))
        @if let Some(tuning) = &folder.tuning { (failures(tuning)) }
        @if let Some(header) = &folder.header { (settings(header)) }
    };
    let (title, subtitle) = match &folder.header {
        Some(header) => (
            format!("Shuttertruth: tuning of {}", header.filter),
            format!(
                "from {}, {} trials on {} scenes",
                header.start,
                folder.trials.len(),
                header.scenes.len()
            ),
        ),
        None => (
            "Shuttertruth: which parameters matter".to_owned(),
            folder.path.display().to_string(),
        ),
    };
    let document = Document {
        title: &title,
        heading: html! { (title) },
        subtitle: &subtitle,
        body: html! { main { (body) } },
        scripts: &[],
        siblings: Siblings::None,
    };
    document.render()
}

fn failures(tuning: &Tuning) -> Markup {
    html! {
        @if !tuning.failed.is_empty() {
            section {
                h2 { "Trials that did not run" }
                ul {
                    @for (trial, reason) in &tuning.failed { li { "trial " (trial) ": " (reason) } }
                }
            }
        }
    }
}

/// Lists all that the trials depended on, and the hashes of the truths.
fn settings(header: &JournalHeader) -> Markup {
    let limit = |limit: Option<f64>| match limit {
        Some(limit) => format!("{limit} times the start's"),
        None => "none".to_owned(),
    };
    let racing = if header.race {
        "clearly worse candidates are dropped"
    } else {
        "none"
    };
    let measured: Vec<&str> = header
        .objectives
        .iter()
        .map(|metric| metric.name())
        .collect();
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
