//! Colours of printed text, as escape codes. Printing leaves them out where no terminal shows them; a word says the same each
//! time.

use anstyle::{AnsiColor, Style};

/// Marks a title.
pub fn heading(text: &str) -> String {
    paint(Style::new().bold(), text)
}

/// Marks text of less weight.
pub fn faint(text: &str) -> String {
    paint(Style::new().dimmed(), text)
}

/// Marks a success.
pub fn good(text: &str) -> String {
    paint(AnsiColor::Green.on_default(), text)
}

/// Marks a failure.
pub fn bad(text: &str) -> String {
    paint(AnsiColor::Red.on_default().bold(), text)
}

/// Marks what is undecided.
pub fn doubtful(text: &str) -> String {
    paint(AnsiColor::Yellow.on_default(), text)
}

/// Counts the columns that a text takes on the screen.
pub fn width(text: &str) -> usize {
    anstream::adapter::strip_str(text)
        .map(|part| part.chars().count())
        .sum()
}

fn paint(style: Style, text: &str) -> String {
    match text.is_empty() {
        true => String::new(),
        false => format!("{style}{text}{style:#}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_take_no_columns() {
        assert_eq!(width(&format!("a {} c", bad("§5"))), 6);
        assert_eq!(heading(""), "");
    }
}
