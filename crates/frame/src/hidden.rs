//! Hidden characters: those that a reader of a name or a message does not see.

/// Returns true for characters that terminals, logs and reports obey instead of showing: control
/// characters, line and paragraph separators, and marks that turn the direction of writing. Names
/// with one are refused; messages are written without.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_the_cursor_or_turns_the_text_is_hidden_and_letters_are_not() {
        for letter in [
            '\n', '\u{1b}', '\u{9b}', '\u{200e}', '\u{2028}', '\u{202e}', '\u{2066}',
        ] {
            assert!(is_hidden(letter), "{letter:?}");
        }
        // The joiner is a part of words, as in Persian.
        for letter in ['a', 'é', '光', '–', '\u{200c}', '\u{1f600}'] {
            assert!(!is_hidden(letter), "{letter:?}");
        }
    }
}
