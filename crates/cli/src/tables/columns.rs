//! Parts that tables of cases and tables of means share.

use metrics::Metric;

use super::layout::{Align, Table};
use crate::output::colors;
use crate::output::wrap::push_wrapped;

/// A column: its title and its score.
pub type Column = (&'static str, Metric);

/// Puts the names of references into brackets: they are no filters.
pub fn bracket_name(name: &str, is_reference: bool) -> String {
    match is_reference {
        true => format!("[{name}]"),
        false => name.to_owned(),
    }
}

/// Makes the note below a table.
pub fn legend_text(text: &str) -> String {
    let mut lines = String::new();
    push_wrapped(&mut lines, 0, text);
    colors::faint(&lines)
}

/// Chooses the style of a row: references are dimmed.
pub fn row_style(is_reference: bool) -> fn(&str) -> String {
    match is_reference {
        true => colors::faint,
        false => str::to_owned,
    }
}

/// Begins a table: names, then numbers.
pub fn number_table(titles: &[&str]) -> Table {
    let mut align = vec![Align::Right; titles.len()];
    align[0] = Align::Left;
    Table::new(titles, &align)
}

/// Lists each thing once, in order.
pub fn list_once<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut listed = Vec::new();
    for one in all {
        if !listed.contains(&one) {
            listed.push(one);
        }
    }
    listed
}
