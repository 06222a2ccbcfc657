//! Parts that tables of cases and tables of means share.

use metrics::Metric;

use super::Table;
use crate::output::{faint, push_wrapped};

/// Columns side by side of a table that has many.
const ABREAST: usize = 3;

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
    faint(&lines)
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

/// Makes tables with a few columns side by side, so that a row fits a terminal.
pub fn abreast_text<R>(
    title: &str,
    columns: &[&str],
    rows: &[R],
    name: impl Fn(&R) -> String,
    cell: impl Fn(&R, &str) -> String,
) -> String {
    let tables = columns.chunks(ABREAST).map(|columns| {
        let mut table = Table::new(title, columns.iter().copied());
        for row in rows {
            table.push(name(row), columns.iter().map(|column| cell(row, column)));
        }
        table.text()
    });
    tables.collect()
}
