//! Parts that tables share.

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

/// Fills the cell of a value, which may be missing.
pub fn cell<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or("n/a".to_owned(), text)
}

/// Writes an interval: `0.052 to 0.053`.
pub fn range_text(ends: [f64; 2], number: impl Fn(f64) -> String) -> String {
    let [low, high] = ends.map(number);
    format!("{low} to {high}")
}

/// Writes the mean of numbers.
pub fn mean_text(numbers: impl Iterator<Item = f64>, text: impl Fn(f64) -> String) -> String {
    let all: Vec<f64> = numbers.collect();
    let mean = (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64);
    cell(mean, text)
}

/// Makes tables with a few columns side by side, so that a row fits a terminal, and the note below them.
pub fn abreast_text<R>(
    title: &str,
    columns: &[String],
    rows: &[R],
    name: impl Fn(&R) -> String,
    cell: impl Fn(&R, &String) -> String,
    legend: &str,
) -> String {
    let tables = columns.chunks(ABREAST).map(|columns| {
        let mut table = Table::new(title, columns);
        for row in rows {
            table.push(name(row), columns.iter().map(|column| cell(row, column)));
        }
        table.text()
    });
    let tables: String = tables.collect();
    format!("\n{tables}\n{}", legend_text(legend))
}

/// Makes a table of Markdown.
pub fn markdown_table(titles: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = format!(
        "| {} |\n|{}\n",
        titles.join(" | "),
        "---|".repeat(titles.len())
    );
    for row in rows {
        text += &format!("| {} |\n", row.join(" | "));
    }
    text
}
