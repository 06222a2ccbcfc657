//! Parts that tables of cases and tables of means share.

use suite::Headline;

use crate::output::colors;
use crate::output::wrap::push_wrapped;

/// Width of the column of names.
pub const NAMES: usize = 29;

/// A column: title, width and score.
pub type Column = (&'static str, usize, Headline);

/// Puts the names of references into brackets: they are no filters.
pub fn bracket_name(name: &str, bar: bool) -> String {
    match bar {
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

/// Dims the rows of references.
pub fn dim_reference(bar: bool, lines: &str) -> String {
    match bar {
        true => colors::faint(lines),
        false => lines.to_owned(),
    }
}

/// Makes the cell of a name; a long name has a line of its own.
pub fn name_cell(name: &str) -> String {
    match name.chars().count() > NAMES - 2 {
        true => format!("  {name}\n{:<NAMES$}", ""),
        false => format!("  {name:<0$}", NAMES - 2),
    }
}

/// Lists each text once, in order.
pub fn list_once<'a>(all: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut listed = Vec::new();
    for one in all {
        if !listed.contains(&one) {
            listed.push(one);
        }
    }
    listed
}
