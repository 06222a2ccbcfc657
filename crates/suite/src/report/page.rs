//! The page around overview and cases.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::gallery::Gallery;
use super::viewer::viewer;
use crate::Run;

/// In the order in which later ones override earlier ones.
const STYLES: [&str; 5] = [
    include_str!("base.css"),
    include_str!("tables.css"),
    include_str!("case.css"),
    include_str!("viewer.css"),
    include_str!("media.css"),
];

/// In the order in which they run.
const SCRIPTS: [&str; 4] = [
    include_str!("theme.js"),
    include_str!("sorting.js"),
    include_str!("viewer.js"),
    include_str!("keys.js"),
];

/// What a browser may do for this page: show what stands in it, and fetch nothing.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; \
     form-action 'none'";

/// The whole document.
pub fn page(run: &Run, overview: &Markup, cases: &[Markup], gallery: &Gallery) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
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
                    (overview)
                    @for case in cases { (case) }
                }
                (viewer(run))
                script #pictures type="application/json" { (PreEscaped(gallery.json())) }
                @for script in SCRIPTS { script { (PreEscaped(script)) } }
            }
        }
    }
}
