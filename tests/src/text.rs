//! Checks of texts.

/// Fails, with the whole text, if it lacks one of `parts`.
#[track_caller]
pub fn assert_contains<T: AsRef<str>>(text: &str, parts: &[T]) {
    for part in parts.iter().map(AsRef::as_ref) {
        assert!(text.contains(part), "\"{part}\" is missing from:\n{text}");
    }
}

/// Joins the words of a text with single spaces: lines break at the width of the terminal.
pub fn squeeze(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Finds a page's first block of code that begins with this text, including its line of back
/// quotes.
pub fn code_block<'a>(page: &'a str, start: &str) -> &'a str {
    let (_, rest) = page.split_once(start).expect(start);
    rest.split("```").next().unwrap_or_default()
}
