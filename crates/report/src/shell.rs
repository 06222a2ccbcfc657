//! Head, styles and theme of pages that show no single run.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// In the order in which later ones override earlier ones.
const STYLES: [&str; 4] = [
    include_str!("assets/base.css"),
    include_str!("assets/tables.css"),
    include_str!("assets/shell.css"),
    include_str!("assets/media.css"),
];

/// What a browser may do for such a page: show what stands in it, and fetch nothing.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; \
     form-action 'none'";

/// The whole document; `scripts` run in their order behind that of the theme.
pub fn shell(title: &str, subtitle: &str, body: &Markup, scripts: &[&str]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                link rel="icon" href="data:,";
                @for style in STYLES { style { (PreEscaped(style)) } }
            }
            body {
                header {
                    h1 { (title) }
                    p { (subtitle) }
                    button #theme type="button" { "Theme: system" }
                }
                main { (body) }
                script { (PreEscaped(include_str!("assets/theme.js"))) }
                @for script in scripts { script { (PreEscaped(script)) } }
            }
        }
    }
}
