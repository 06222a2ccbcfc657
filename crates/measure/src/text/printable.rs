//! Escapes for text that others wrote, so that it is safe in a terminal, a log and a summary.

use std::borrow::Cow;
use std::fmt::Write;
use std::path::Path;

use frame::is_hidden;

/// Mark before every line of a message but the first, so that no line begins with what a log reads
/// as a command.
const CONTINUED: &str = "  | ";

/// Puts text on one line: control characters, line breaks among them, and characters that change
/// the direction of writing become escapes such as `\n` and `\u001b`, as in JSON. Other text stays
/// as it is.
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.chars().any(is_hidden) {
        Cow::Owned(text.chars().fold(String::new(), |mut line, letter| {
            push(&mut line, letter);
            line
        }))
    } else {
        Cow::Borrowed(text)
    }
}

/// Writes a path as [`printable`] text.
pub fn printable_path(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}

/// Escapes each line of a message as [`printable`] does, and puts a mark before all but the first.
/// Lines of a compiler that quote a source after a mark of their own get none.
pub fn printable_lines(text: &str) -> String {
    let mut lines = text.split('\n').map(printable);
    let mut message = lines.next().unwrap_or_default().into_owned();
    for line in lines {
        message.push('\n');
        if !line.is_empty() && !is_quoted(&line) {
            message.push_str(CONTINUED);
        }
        message.push_str(&line);
    }
    message
}

/// Returns whether a line is a compiler's: `11 │     let trail = ..`.
fn is_quoted(line: &str) -> bool {
    line.trim_start_matches(|letter: char| letter == ' ' || letter.is_ascii_digit())
        .starts_with(['┌', '│'])
}

fn push(line: &mut String, letter: char) {
    match letter {
        '\n' => line.push_str("\\n"),
        '\r' => line.push_str("\\r"),
        '\t' => line.push_str("\\t"),
        letter if is_hidden(letter) => {
            let _ = write!(line, "\\u{:04x}", u32::from(letter));
        }
        letter => line.push(letter),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_become_escapes_and_other_text_stays() {
        for (text, expected) in [
            ("fan, \u{e9}t\u{e9} \u{6247}", "fan, \u{e9}t\u{e9} \u{6247}"),
            ("a\n::error::b", "a\\n::error::b"),
            ("\u{1b}[2J\u{7}", "\\u001b[2J\\u0007"),
            ("a\r\tb\u{9b}", "a\\r\\tb\\u009b"),
            ("\u{202e}nitna", "\\u202enitna"),
        ] {
            assert_eq!(printable(text), expected);
        }
    }

    #[test]
    fn no_line_of_a_message_begins_with_a_command() {
        let text = printable_lines("a\n::error::b\n \u{1b}]0;c");
        assert_eq!(text, "a\n  | ::error::b\n  |  \\u001b]0;c");
        let compiler = "a\n   ┌─ b.wgsl:11:2\n   │\n11 │ ::error::c";
        assert_eq!(printable_lines(compiler), compiler);
    }
}
