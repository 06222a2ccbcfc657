//! Texts of others that reach terminals, logs and pages.

use frame::is_hidden;

/// What is wrong with a one-line text that is shown to people: `None` where nothing is.
///
/// Refused are control characters, which move cursors and begin lines; marks that reverse the direction of writing; and words
/// that a CI service takes for a command, as GitHub takes `::error::`.
pub(crate) fn unfit(text: &str) -> Option<String> {
    if let Some(found) = text.chars().find(|c| has_no_ink(*c)) {
        return Some(format!(
            "holds the control character U+{:04X}; allowed: one line of visible characters",
            u32::from(found)
        ));
    }
    let commands = ["::", "##["];
    let mut words = text.split_whitespace();
    let word = words.find(|word| commands.iter().any(|begin| word.starts_with(begin)))?;
    Some(format!(
        "has the word \"{word}\", which CI services take for a command; put another character before it"
    ))
}

/// The text with every control character written as its number.
pub(crate) fn without_controls(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' => shown.push(' '),
            c if has_no_ink(c) => shown += &format!("\\u{{{:x}}}", u32::from(c)),
            c => shown.push(c),
        }
    }
    shown
}

/// Hidden characters, and those of no width.
fn has_no_ink(c: char) -> bool {
    is_hidden(c) || matches!(c, '\u{200b}'..='\u{200d}' | '\u{2060}'..='\u{2065}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_and_commands_are_unfit() {
        for text in [
            "two\nlines",
            "red \u{1b}[31m",
            "\u{9b}31m",
            "back\rward",
            "\u{202e}desrever",
            "a\u{2028}b",
            "::error::no",
            "see ::error file=a::no",
            "##[error]no",
        ] {
            assert!(unfit(text).is_some(), "{text:?}");
        }
        for text in [
            "",
            "Größe × 2 – 光",
            "std::max(a, b) ## 3: yes",
            "µ, σ² ≤ 1",
        ] {
            assert_eq!(unfit(text), None);
        }
    }

    #[test]
    fn a_control_character_is_shown_as_its_number() {
        assert_eq!(without_controls("a\u{1b}[0m\nb\tc"), "a\\u{1b}[0m\\u{a}b c");
    }
}
