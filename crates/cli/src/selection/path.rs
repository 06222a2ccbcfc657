//! The difference between a name and a path.

/// Tells whether a text is a path. A path has a separator; a text without one is a name, whatever lies in the current folder.
pub fn is_path(text: &str) -> bool {
    text.contains(['/', '\\'])
}
