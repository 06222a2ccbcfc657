//! Page of a tuning: its choice, its trials, and how far to trust them.

mod choice;
mod convergence;
mod folder;
mod folds;
mod front;
mod importance;
mod scenes;
mod settings;
mod slices;

use maud::{Markup, html};

use crate::document::{Document, Siblings};
use suite::Error;

pub use folder::TuneFolder;

/// Writes the page of a folder that `tune` made. The same folder makes the same bytes.
pub fn tuning_page(folder: &TuneFolder) -> Result<String, Error> {
    let body = html! {
        @if let Some(tuning) = &folder.tuning { (choice::summary(tuning)) }
        @if let Some(tuning) = &folder.tuning { (choice::values(tuning)) }
        @if !folder.trials.is_empty() {
            (front::front_section(folder))
            (convergence::convergence(&folder.trials))
        }
        @if let Some(tuning) = &folder.tuning {
            (folds::folds(&tuning.folds))
            (scenes::tuned_on(tuning))
            (scenes::held_out(&tuning.held_out))
        }
        @if let Some(found) = &folder.sensitivity { (importance::importance(found)) }
        (slices::slices(folder))
        @if let Some(tuning) = &folder.tuning { (failures(tuning)) }
        @if let Some(header) = &folder.header { (settings::settings(header)) }
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
    Ok(document.render())
}

fn failures(tuning: &tune::Tuning) -> Markup {
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
