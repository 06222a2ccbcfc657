//! Lines that fit a terminal, and counts in them.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

use terminal_size::{Width, terminal_size_of};

use super::Text;

/// Columns of printed text if no terminal gives its own.
const USUAL_COLUMNS: usize = 80;
/// Range of columns for wrapped text: narrower lines fit no table, longer ones are hard to read.
const COLUMNS: RangeInclusive<usize> = 60..=120;

/// Looks up the columns of standard output's terminal, or else the variable COLUMNS, as the help
/// does.
pub fn terminal_columns() -> usize {
    static FOUND: OnceLock<usize> = OnceLock::new();
    *FOUND.get_or_init(|| {
        let terminal = terminal_size_of(std::io::stdout());
        let named = || std::env::var("COLUMNS").ok()?.parse().ok();
        let columns = terminal.map(|(Width(columns), _)| usize::from(columns));
        columns
            .or_else(named)
            .map_or(USUAL_COLUMNS, |columns: usize| {
                columns.clamp(*COLUMNS.start(), *COLUMNS.end())
            })
    })
}

/// Adds one line of text, broken between words if it is too long, with a deeper indent after the
/// first line. Line breaks in it become escapes, since names and files may contain them.
pub fn push_wrapped(text: &mut Text, indent: usize, line: impl Into<Text>) {
    let mut column = indent;
    *text += " ".repeat(indent);
    for (index, word) in line.into().into_line().words().iter().enumerate() {
        let length = word.width();
        if index > 0 && column + 1 + length > terminal_columns() {
            text.push_gap(&format!("\n{}", " ".repeat(indent + 4)), word);
            column = indent + 4;
        } else if index > 0 {
            text.push_gap(" ", word);
            column += 1;
        }
        *text += word;
        column += length;
    }
    *text += "\n";
}

/// Wraps lines, and keeps their indentation. Keeps compiler output aligned.
pub fn wrap_lines(text: &str) -> String {
    let mut wrapped = Text::default();
    for line in text.lines() {
        let words = line.trim_start_matches(' ');
        if words.is_empty() || line.contains(['┌', '│']) {
            wrapped += format!("{line}\n")
        } else {
            push_wrapped(&mut wrapped, line.len() - words.len(), words)
        }
    }
    wrapped.plain()
}

/// Formats a count: `1 case`, `2 cases`.
pub fn count_text(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("1 {one}"),
        count => format!("{count} {many}"),
    }
}
