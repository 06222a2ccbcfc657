//! What is wrong with a scene on disk, and where.

use std::fmt;
use std::path::{Path, PathBuf};

use frame::is_hidden;

/// A scene that cannot be used. Reads `path:line: reason`; the reason says what was found and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// The file to mend.
    pub path: PathBuf,
    /// Its line, counted from 1, where there is one.
    pub line: Option<usize>,
    /// What was found, what is allowed, the way out.
    pub reason: String,
}

impl SceneError {
    /// An error about a file as a whole.
    pub(super) fn file(path: &Path, reason: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            line: None,
            reason: reason.into(),
        }
    }

    /// An error in one line of a file, counted from 1.
    pub(super) fn line(path: &Path, line: usize, reason: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            ..Self::file(path, reason)
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {}", self.reason)
    }
}

impl std::error::Error for SceneError {}

/// Most names that a message lists.
const MOST_LISTED: usize = 40;

/// `a, b, c` for messages; `none` where there is nothing.
pub(super) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names = names.into_iter();
    let mut listed: Vec<&str> = names.by_ref().take(MOST_LISTED).collect();
    let more = match names.count() {
        0 => String::new(),
        more => format!("{more} more"),
    };
    if !more.is_empty() {
        listed.push(&more);
    }
    if listed.is_empty() {
        "none".into()
    } else {
        listed.join(", ")
    }
}

/// What names of objects and variants may hold; they become names of channels and folders.
pub(super) fn is_name(word: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    !word.is_empty() && word.chars().all(allowed)
}

/// What is wrong with a text that people are to read, if anything: characters that move the cursor, end a line, or turn
/// the direction of writing, which terminals, logs and reports obey.
pub(super) fn hidden(text: &str) -> Option<String> {
    let found = text.chars().find(|letter| is_hidden(*letter))?;
    Some(format!(
        "holds the control character U+{:04X}; allowed: what can be seen, in one line",
        u32::from(found)
    ))
}
