//! Texts of one line. The command line escapes what it prints.

use frame::is_hidden;

/// Refuses a one-line text that should not be shown to people.
///
/// Refused are control characters, which move cursors and begin lines; marks that reverse the
/// direction of writing; and words that a CI service reads as a command, such as GitHub's
/// `::error::`.
pub(crate) fn check_line(text: &str) -> Result<(), String> {
    if let Some(found) = text.chars().find(|c| is_invisible(*c)) {
        return Err(format!(
            "holds the control character U+{:04X}; allowed: one line of visible characters",
            u32::from(found)
        ));
    }
    let commands = ["::", "##["];
    let mut words = text.split_whitespace();
    match words.find(|word| commands.iter().any(|begin| word.starts_with(begin))) {
        None => Ok(()),
        Some(word) => Err(format!(
            "has the word \"{word}\", which CI services take for a command; put another character before it"
        )),
    }
}

/// Returns true for hidden characters and for those of no width.
fn is_invisible(c: char) -> bool {
    is_hidden(c) || matches!(c, '\u{200b}'..='\u{200d}' | '\u{2060}'..='\u{2065}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_and_commands_are_refused() {
        for text in [
            "back\rward",
            "a\u{2028}b",
            "see ::error file=a::no",
            "##[error]no",
        ] {
            assert!(check_line(text).is_err(), "{text:?}");
        }
        for text in [
            "",
            "Größe × 2 – 光",
            "std::max(a, b) ## 3: yes",
            "µ, σ² ≤ 1",
        ] {
            assert_eq!(check_line(text), Ok(()));
        }
    }
}
