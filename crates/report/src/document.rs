//! Document around every page: head, styles, theme and scripts.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Style sheets; later ones override earlier ones.
const STYLES: [&str; 7] = [
    include_str!("assets/base.css"),
    include_str!("assets/tables.css"),
    include_str!("assets/charts.css"),
    include_str!("assets/case.css"),
    include_str!("assets/viewer.css"),
    include_str!("assets/comparison.css"),
    include_str!("assets/media.css"),
];

/// Permissions of a page: a browser may show what stands in it, and fetch nothing.
const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; \
     script-src 'unsafe-inline'";

/// A page before it is text.
pub struct Document<'a> {
    /// Name in the browser's window.
    pub title: &'a str,
    /// Name at the top of the page.
    pub heading: Markup,
    /// Words beside the heading.
    pub subtitle: &'a str,
    /// Content of the page, with the data that scripts read.
    pub body: Markup,
    /// Scripts in the order in which they run, behind that of the theme.
    pub scripts: &'a [&'a str],
    /// True if the page loads files that lie beside it.
    pub loads_siblings: bool,
}

impl Document<'_> {
    /// Writes the page as HTML.
    pub fn render(self) -> String {
        // Browsers differ in what they call files beside a page on a disk.
        let beside = if self.loads_siblings {
            " 'self' file:"
        } else {
            ""
        };
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(format!("{POLICY}{beside}"));
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    link rel="icon" href="data:,";
                    @for style in STYLES { style { (PreEscaped(style)) } }
                }
                body {
                    header {
                        h1 { (self.heading) }
                        p { (self.subtitle) }
                        button #theme type="button" { "Theme: system" }
                    }
                    (self.body)
                    script { (PreEscaped(include_str!("assets/theme.js"))) }
                    @for script in self.scripts { script { (PreEscaped(script)) } }
                }
            }
        };
        page.into_string()
    }
}
