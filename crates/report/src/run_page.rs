//! Page of a run: overview, cases, viewer and their numbers.

use maud::{Markup, PreEscaped, html};

use crate::case::legend::colors;
use crate::case::viewer::viewer;
use crate::document::{Document, Siblings};
use crate::pixels::report_files::SceneNumbers;
use crate::sequence::SEQUENCES_PAGE;
use suite::Run;

/// Scripts in the order in which they run.
const SCRIPTS: [&str; 8] = [
    include_str!("assets/planes.js"),
    include_str!("assets/paint.js"),
    include_str!("assets/pictures.js"),
    include_str!("assets/viewer.js"),
    include_str!("assets/readout.js"),
    include_str!("assets/keys.js"),
    include_str!("assets/overview.js"),
    include_str!("assets/address.js"),
];

/// Writes the whole page. `links_sequences` is true where the page lies beside that of the sequences.
pub fn run_page(
    run: &Run,
    overview: &Markup,
    cases: &[Markup],
    numbers: &SceneNumbers,
    links_sequences: bool,
) -> String {
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
                    p { "The numbers need no script; pictures, sorting and keys do." }
                }
                (failures(run))
                @if !run.sequences.is_empty() {
                    p.note {
                        "Below are the first frames of sequences of " (run.frames.count) " frames. "
                        "They play on the page "
                        @if links_sequences { a href=(SEQUENCES_PAGE) { (SEQUENCES_PAGE) } } @else { (SEQUENCES_PAGE) }
                        " beside run.json."
                    }
                }
                (overview)
                @for case in cases { (case) }
            }
            (viewer(run))
            (scene_numbers(numbers))
            script #colors type="application/json" { (PreEscaped(colors())) }
        },
        scripts: &SCRIPTS,
        siblings: match numbers.folder {
            Some(_) => Siblings::Numbers,
            None => Siblings::None,
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

/// Embeds the numbers: base64 holds no character that HTML escapes.
fn scene_numbers(numbers: &SceneNumbers) -> Markup {
    html! {
        div #numbers hidden data-folder=[numbers.folder.as_ref()] {
            @if numbers.folder.is_none() {
                @for (scene, text) in numbers.texts.iter().enumerate() {
                    script type="application/json" data-scene=(scene) { (PreEscaped(text)) }
                }
            }
        }
    }
}
