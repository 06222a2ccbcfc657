//! Errors in the files of a scene, and the rules for names and texts in them.

use std::ops::Range;
use std::path::{Path, PathBuf};

use frame::is_hidden;

use crate::limits::LARGEST_NUMBER;

/// Error in a scene's files. It reads `path:line: reason`; the reason says what was found and what
/// is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{path}:{line} {reason}",
    path = path.display(),
    line = line.map_or_else(String::new, |line| format!("{line}:"))
)]
pub struct SceneError {
    /// File to mend.
    pub path: PathBuf,
    /// Line to mend, counted from 1; none if the error concerns the whole file.
    pub line: Option<usize>,
    /// The cause: what was found, what is allowed, and the way out.
    pub reason: String,
}

impl SceneError {
    /// Makes an error about a whole file.
    pub(super) fn in_file(path: &Path, reason: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            line: None,
            reason: reason.into(),
        }
    }

    /// Makes an error about one line of a file, counted from 1.
    pub(super) fn at_line(path: &Path, line: usize, reason: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            ..Self::in_file(path, reason)
        }
    }

    /// Makes the error about a mesh that no ray can hit.
    pub(super) fn without_area(path: &Path, triangles: usize) -> Self {
        let reason =
            format!("all {triangles} triangles have no area; a mesh needs at least one with area");
        Self::in_file(path, reason)
    }
}

/// Error at a place of a scene.toml, before its line is known: [`Document::locate`] finds that.
///
/// [`Document::locate`]: super::document::Document::locate
#[derive(Debug)]
pub(super) struct Slip {
    /// Bytes of the text.
    pub(super) place: Range<usize>,
    /// What was found, what is allowed, and the way out.
    pub(super) reason: String,
}

impl Slip {
    pub(super) fn new(place: Range<usize>, reason: impl Into<String>) -> Self {
        Self {
            place,
            reason: reason.into(),
        }
    }
}

/// Most names that a message lists.
const MAX_LISTED: usize = 40;

/// Joins names for a message: `a, b, c`, or `none`.
pub(super) fn join_names<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names = names.into_iter();
    let mut listed: Vec<&str> = names.by_ref().take(MAX_LISTED).collect();
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

/// Lists the allowed numbers, for a message about a finite number or about none.
pub(super) fn allowed_numbers(is_finite: bool) -> String {
    if is_finite {
        format!("numbers from -{LARGEST_NUMBER:e} to {LARGEST_NUMBER:e}")
    } else {
        "finite numbers".to_owned()
    }
}

/// Checks a name of an object or variant, which becomes part of channel and folder names.
pub(super) fn check_name(name: &str) -> Result<(), String> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(allowed) {
        return Ok(());
    }
    Err(format!(
        "name \"{name}\"; allowed: letters, digits, _ and -"
    ))
}

/// Refuses characters that terminals, logs and reports obey: they move the cursor, end a line, or
/// turn the direction of writing. The error follows the name of the text.
pub(super) fn check_visible(text: &str) -> Result<(), String> {
    match text.chars().find(|letter| is_hidden(*letter)) {
        None => Ok(()),
        Some(letter) => Err(format!(
            "holds the control character U+{:04X}; allowed: one line of visible characters",
            u32::from(letter)
        )),
    }
}
