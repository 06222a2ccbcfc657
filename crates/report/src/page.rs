//! The page around overview and cases.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::files::Shelves;
use super::legend::colors;
use super::viewer::viewer;
use suite::Run;

/// In the order in which later ones override earlier ones.
const STYLES: [&str; 6] = [
    include_str!("assets/base.css"),
    include_str!("assets/tables.css"),
    include_str!("assets/case.css"),
    include_str!("assets/charts.css"),
    include_str!("assets/viewer.css"),
    include_str!("assets/media.css"),
];

/// In the order in which they run.
const SCRIPTS: [&str; 7] = [
    include_str!("assets/theme.js"),
    include_str!("assets/sorting.js"),
    include_str!("assets/planes.js"),
    include_str!("assets/paint.js"),
    include_str!("assets/viewer.js"),
    include_str!("assets/readout.js"),
    include_str!("assets/keys.js"),
];

/// What a browser may do for this page: show what stands in it, and fetch nothing.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; \
     script-src 'unsafe-inline'";

/// The whole document.
pub fn page(run: &Run, overview: &Markup, cases: &[Markup], shelves: &Shelves) -> Markup {
    // Files beside the page count as its own; browsers differ in what they call them on a disk.
    let beside = shelves.folder.as_ref().map_or("", |_| " 'self' file:");
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(format!("{POLICY}{beside}"));
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Shuttertruth report" }
                link rel="icon" href="data:,";
                @for style in STYLES { style { (PreEscaped(style)) } }
            }
            body {
                header {
                    h1 { a href="#overview" { "Shuttertruth" } }
                    p { (run.program) ", " (run.width) "x" (run.height) }
                    button #theme type="button" { "Theme: system" }
                }
                main {
                    noscript {
                        p { "The numbers need no script; pictures, sorting and keys do." }
                    }
                    (failed(run))
                    (overview)
                    @for case in cases { (case) }
                }
                (viewer(run, shelves.precision))
                (numbers(shelves))
                script #colors type="application/json" { (PreEscaped(colors())) }
                @for script in SCRIPTS { script { (PreEscaped(script)) } }
            }
        }
    }
}

/// The cases that failed, above all others.
fn failed(run: &Run) -> Markup {
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

/// Base64 and numbers hold no character that HTML escapes.
fn numbers(shelves: &Shelves) -> Markup {
    html! {
        div #shelves hidden data-precision=(shelves.precision.name()) data-folder=[shelves.folder.as_ref()] {
            @if shelves.folder.is_none() {
                @for (scene, text) in shelves.texts.iter().enumerate() {
                    script type="application/json" data-scene=(scene) { (PreEscaped(text)) }
                }
            }
        }
    }
}
