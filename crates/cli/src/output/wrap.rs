//! Lines that fit a terminal.

use crate::output::colors::width;

/// Columns of all printed text.
pub const WIDTH: usize = 80;

/// Adds a line and breaks it between words where it is too long; later lines are indented further.
pub fn push_wrapped(text: &mut String, indent: usize, line: &str) {
    let mut column = indent;
    *text += &" ".repeat(indent);
    for (index, word) in line.split(' ').enumerate() {
        let length = width(word);
        if index > 0 && column + 1 + length > WIDTH {
            *text += &format!("\n{}", " ".repeat(indent + 4));
            column = indent + 4;
        } else if index > 0 {
            *text += " ";
            column += 1;
        }
        *text += word;
        column += length;
    }
    *text += "\n";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_break_between_words_and_long_words_do_not() {
        let mut text = String::new();
        push_wrapped(&mut text, 2, &["word"; 30].join(" "));
        push_wrapped(&mut text, 2, &"x".repeat(100));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].chars().count() <= WIDTH && lines[0].starts_with("  word"));
        assert!(lines[1].starts_with("      word"));
        assert_eq!(lines[2].trim(), "x".repeat(100));
    }
}
