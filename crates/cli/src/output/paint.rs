//! Colours of what is printed. They stand in the text as escape codes, which the command line leaves out where no terminal
//! reads them; a word says the same each time.

use anstyle::{AnsiColor, Style};

/// A title.
pub fn heading(text: &str) -> String {
    painted(Style::new().bold(), text)
}

/// What stands behind the rest.
pub fn faint(text: &str) -> String {
    painted(Style::new().dimmed(), text)
}

/// A success.
pub fn good(text: &str) -> String {
    painted(AnsiColor::Green.on_default(), text)
}

/// A failure.
pub fn bad(text: &str) -> String {
    painted(AnsiColor::Red.on_default().bold(), text)
}

/// Neither the one nor the other.
pub fn doubtful(text: &str) -> String {
    painted(AnsiColor::Yellow.on_default(), text)
}

/// Columns that a text takes on the screen.
pub fn width(text: &str) -> usize {
    anstream::adapter::strip_str(text)
        .map(|part| part.chars().count())
        .sum()
}

fn painted(style: Style, text: &str) -> String {
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
