//! Document around every page: head, styles, theme and scripts.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Style sheets; later ones override earlier ones.
const STYLES: [&str; 9] = [
    include_str!("assets/base.css"),
    include_str!("assets/tables.css"),
    include_str!("assets/charts.css"),
    include_str!("assets/case.css"),
    include_str!("assets/viewer.css"),
    include_str!("assets/live.css"),
    include_str!("assets/comparison.css"),
    include_str!("assets/sequence.css"),
    include_str!("assets/media.css"),
];

/// Permissions of a page: a browser may show its contents, and fetch only the allowed files next to
/// it. Browsers differ in what counts as files next to a page on a disk.
fn policy(siblings: Siblings) -> String {
    let [pictures, scripts] = [Siblings::Pictures, Siblings::Scripts].map(|kind| match kind {
        _ if kind == siblings => " 'self' file:",
        _ => "",
    });
    format!(
        "default-src 'none'; img-src data:{pictures}; style-src 'unsafe-inline'; base-uri 'none'; \
         form-action 'none'; script-src 'unsafe-inline'{scripts}"
    )
}

/// Files next to a page that it loads.
#[derive(Clone, Copy, PartialEq)]
pub enum Siblings {
    /// No files.
    None,
    /// Scripts with data.
    Scripts,
    /// Pictures.
    Pictures,
}

/// Writes JSON for scripts into the element `id`.
pub fn script_data(id: &str, json: &str) -> Markup {
    // No text may end the enclosing script.
    let text = json.replace('<', "\\u003c");
    html! { script id=(id) type="application/json" { (PreEscaped(text)) } }
}

/// A page before conversion to text.
pub struct Document<'a> {
    /// Name in the browser's window.
    pub title: &'a str,
    /// Name at the top of the page.
    pub heading: Markup,
    /// Words next to the heading.
    pub subtitle: &'a str,
    /// Content below the title.
    pub body: Markup,
    /// Scripts in the order in which they run, after the theme's.
    pub scripts: &'a [&'a str],
    /// Files that the page loads.
    pub siblings: Siblings,
}

impl Document<'_> {
    /// Writes the page as HTML.
    pub fn render(self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta http-equiv="Content-Security-Policy" content=(policy(self.siblings));
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
