//! Parts that tables share.

use metrics::Metric;

use crate::output::{Text, faint, push_wrapped};

/// A column: its title and its score.
pub type Column = (&'static str, Metric);

/// Puts the names of references, which are not filters, into brackets.
pub fn bracket_name(name: &str, is_reference: bool) -> String {
    if is_reference {
        format!("[{name}]")
    } else {
        name.to_owned()
    }
}

/// Makes the note below a table.
pub fn legend_text(text: &str) -> Text {
    let mut lines = Text::default();
    push_wrapped(&mut lines, 0, text);
    faint(&lines.plain())
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

/// Formats a value that may be missing.
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

/// Makes a table of Markdown. Text of others in a cell is escaped before:
/// [`measure::escape_markdown`].
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
