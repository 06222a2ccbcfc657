//! Styles of printed text. Inside the program a style is a mark, a Unicode noncharacter that no
//! file needs. Printing turns only marks into terminal codes; codes in names and files become
//! escapes.

use anstyle::{AnsiColor, Reset, Style};
use measure::printable;

/// Marks a title of one line.
pub fn heading(text: &str) -> String {
    bold(&printable(text))
}

/// Marks the titles of columns.
pub fn bold(text: &str) -> String {
    paint('\u{fdd1}', text)
}

/// Marks less important text.
pub fn faint(text: &str) -> String {
    paint('\u{fdd2}', text)
}

/// Marks a success.
pub fn good(text: &str) -> String {
    paint('\u{fdd3}', text)
}

/// Marks a failure.
pub fn bad(text: &str) -> String {
    paint('\u{fdd4}', text)
}

/// Marks an undecided result.
pub fn doubtful(text: &str) -> String {
    paint('\u{fdd5}', text)
}

/// Mark that ends a style.
const END: char = '\u{fdd0}';

fn paint(mark: char, text: &str) -> String {
    if text.is_empty() {
        String::new()
    } else {
        format!("{mark}{text}{END}")
    }
}

/// Finds the style that a mark begins.
fn style(mark: char) -> Option<Style> {
    match mark {
        '\u{fdd1}' => Some(Style::new().bold()),
        '\u{fdd2}' => Some(Style::new().dimmed()),
        '\u{fdd3}' => Some(AnsiColor::Green.on_default()),
        '\u{fdd4}' => Some(AnsiColor::Red.on_default().bold()),
        '\u{fdd5}' => Some(AnsiColor::Yellow.on_default()),
        _ => None,
    }
}

/// Counts the columns of a text on the screen.
pub fn width(text: &str) -> usize {
    let is_shown = |letter: &char| *letter != END && style(*letter).is_none();
    text.chars().filter(is_shown).count()
}

/// Makes text for a terminal: colours for marks, escapes for control characters except line breaks.
pub fn terminal_text(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(printable).collect();
    let mut shown = String::new();
    for letter in lines.join("\n").chars() {
        match style(letter) {
            Some(style) => shown += &style.to_string(),
            None if letter == END => shown += &Reset.to_string(),
            None => shown.push(letter),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_take_no_columns_and_alone_become_codes() {
        let text = format!("a {} c\u{1b}[2J\n", bad("§5"));
        assert_eq!(width("a §5 c"), width(&format!("a {} c", bad("§5"))));
        assert_eq!(
            terminal_text(&text),
            "a \u{1b}[1m\u{1b}[31m§5\u{1b}[0m c\\u001b[2J\n"
        );
        assert_eq!(heading(""), "");
    }
}
