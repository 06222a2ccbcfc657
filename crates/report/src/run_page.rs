//! Page of a run: overview, cases, viewer and their numbers.

use std::path::Path;

use maud::{Markup, PreEscaped, html};
use measure::Run;

use crate::case::legend::colors;
use crate::case::viewer::{VIEWER_SCRIPTS, case_words, viewer};
use crate::document::{Document, Siblings, script_data};
use crate::pixels::report_files::{Place, folder_name};
use crate::sequence::SEQUENCES_PAGE;

/// Scripts that run after the viewer's, in their order.
const SCRIPTS: [&str; 8] = [
    include_str!("assets/live_run.js"),
    include_str!("assets/live_bench.js"),
    include_str!("assets/live_flip.js"),
    include_str!("assets/live_folder.js"),
    include_str!("assets/live_panel.js"),
    include_str!("assets/sort.js"),
    include_str!("assets/overview.js"),
    include_str!("assets/address.js"),
];

/// Contents of a run's page.
pub struct PageContent<'a> {
    /// All scenes and filters at a glance.
    pub overview: &'a Markup,
    /// Sections of cases, then of filters.
    pub sections: &'a [Markup],
    /// Numbers of the pictures.
    pub numbers: &'a Place,
    /// True if the sections of cases contain their tables.
    pub has_tables: bool,
    /// True if some cases are live.
    pub has_live: bool,
    /// True if the page is next to the page of sequences.
    pub links_sequences: bool,
}

impl PageContent<'_> {
    /// Returns whether the page loads files next to it.
    fn has_siblings(&self) -> bool {
        self.has_live || matches!(self.numbers, Place::Beside(_))
    }
}

/// Writes the whole page for the path `html`.
pub fn run_page(run: &Run, content: &PageContent, html: &Path) -> String {
    let document = Document {
        title: "Shuttertruth report",
        heading: html! { a href="#overview" { "Shuttertruth" } },
        subtitle: &format!(
            "{}, {}x{}",
            run.program, run.render.width, run.render.height
        ),
        body: html! {
            main {
                noscript {
                    p { (script_note(content.has_tables)) }
                }
                (failures(run))
                @if !run.sequences.is_empty() {
                    p.note {
                        "Below are the first frames of sequences of " (run.frames.count) " frames. "
                        "They play on the page "
                        @if content.links_sequences { a href=(SEQUENCES_PAGE) { (SEQUENCES_PAGE) } } @else { (SEQUENCES_PAGE) }
                        " next to run.json."
                    }
                }
                (content.overview)
                @for section in content.sections { (section) }
            }
            (viewer(run.render.size(), &case_words))
            (scene_numbers(content, html))
            (script_data("colors", &colors()))
        },
        scripts: &[&VIEWER_SCRIPTS[..], &SCRIPTS].concat(),
        siblings: if content.has_siblings() {
            Siblings::Scripts
        } else {
            Siblings::None
        },
    };
    document.render()
}

/// Lists the cases that failed.
fn failures(run: &Run) -> Markup {
    html! {
        @if !run.failures.is_empty() {
            section #failed {
                h2 { "Failed" }
                ul {
                    @for failure in &run.failures {
                        li { strong { (failure.scene) " / " (failure.filter) } ": " (failure.reason) }
                    }
                }
            }
        }
    }
}

/// Describes what needs scripts.
fn script_note(has_tables: bool) -> &'static str {
    if has_tables {
        "The numbers need no script; pictures, sorting and keys do."
    } else {
        "The tables of cases need scripts: there are too many for one page. Those of the overview need none."
    }
}

/// Embeds the numbers, and names the folder of files next to the page: base64 contains no character
/// that HTML escapes.
fn scene_numbers(content: &PageContent, page: &Path) -> Markup {
    let folder = content.has_siblings().then(|| folder_name(page));
    html! {
        div #numbers hidden data-folder=[folder] {
            @if let Place::Page(texts) = content.numbers {
                @for (scene, text) in texts.iter().enumerate() {
                    script type="application/json" data-scene=(scene) { (PreEscaped(text)) }
                }
            }
        }
    }
}
