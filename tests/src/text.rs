//! Checks of texts.

/// Fails, with the whole text, if it lacks one of `parts`.
#[track_caller]
pub fn assert_contains(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "\"{part}\" is missing from:\n{text}");
    }
}
