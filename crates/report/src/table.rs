//! Tables that scroll sideways if they are wider than the page.

use maud::{Markup, html};

/// Heading of a column; its kind sets the column's style.
#[derive(Clone, Copy)]
pub enum Column<'a> {
    /// Numbers, or the names of the rows.
    Plain(&'a str),
    /// Words.
    Text(&'a str),
    /// One-line charts.
    Chart(&'a str),
}

/// Writes a table. Without a caption, only screen readers get the label.
pub fn scroll_table(
    class: Option<&str>,
    label: &str,
    caption: Option<&str>,
    columns: &[Column],
    rows: &Markup,
) -> Markup {
    grouped_table(class, label, caption, columns, &html! { tbody { (rows) } })
}

/// Writes a table with the given bodies.
pub fn grouped_table(
    class: Option<&str>,
    label: &str,
    caption: Option<&str>,
    columns: &[Column],
    bodies: &Markup,
) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(label) {
            table class=[class] {
                @match caption {
                    Some(caption) => caption { (caption) },
                    None => caption.unseen { (label) },
                }
                thead {
                    tr {
                        @for column in columns {
                            @match column {
                                Column::Plain(title) => th scope="col" { (title) },
                                Column::Text(title) => th.text scope="col" { (title) },
                                Column::Chart(title) => th.chart scope="col" { (title) },
                            }
                        }
                    }
                }
                (bodies)
            }
        }
    }
}
