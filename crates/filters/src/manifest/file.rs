//! Text of `filter.toml`, and errors that name its lines.

use std::path::Path;

use serde::de::DeserializeOwned;
use toml::Spanned;

use crate::FilterError;
use crate::one_line::check_line;

/// Upper limit on parameters, presets, textures and passes of a filter, each.
pub const MAX_ENTRIES: usize = 256;

/// `filter.toml`, for messages that name its lines.
pub(super) struct File<'a> {
    pub path: &'a Path,
    pub text: &'a str,
}

impl File<'_> {
    /// Reads the text; the error ends with `allowed`.
    pub fn read<T: DeserializeOwned>(&self, allowed: &str) -> Result<T, FilterError> {
        toml::from_str(self.text).map_err(|error| {
            let start = error.span().map(|span| span.start);
            self.refuse(start, format!("{}{allowed}", error.message()))
        })
    }

    /// Makes an error that names the line of an offset.
    pub fn refuse(&self, offset: Option<usize>, reason: String) -> FilterError {
        let line = offset.map(|offset| self.line(offset));
        FilterError::in_file(self.path, line, reason.replace('\n', "; "))
    }

    /// Refuses a text that would disturb the terminal, log or page that shows it.
    pub fn check_line<T>(
        &self,
        place: &Spanned<T>,
        name: &str,
        text: &str,
    ) -> Result<String, FilterError> {
        match check_line(text) {
            Ok(()) => Ok(text.to_owned()),
            Err(reason) => Err(self.at(place, format!("{name} {reason}"))),
        }
    }

    /// Finds the lines of the tables of one kind; refuses more than [`MAX_ENTRIES`].
    pub fn lines<T>(&self, kind: &str, entries: &[Spanned<T>]) -> Result<Vec<usize>, FilterError> {
        match entries.get(MAX_ENTRIES) {
            None => Ok((entries.iter().map(|entry| self.line(entry.span().start))).collect()),
            Some(first_too_many) => Err(self.at(
                first_too_many,
                format!(
                    "{} [[{kind}]]; allowed: at most {MAX_ENTRIES}; divide the filter in two",
                    entries.len()
                ),
            )),
        }
    }

    /// Makes an error that names the line of a value.
    pub fn at<T>(&self, place: &Spanned<T>, reason: String) -> FilterError {
        self.refuse(Some(place.span().start), reason)
    }

    /// Finds the line of an offset, from 1.
    pub fn line(&self, offset: usize) -> usize {
        let before = self.text.as_bytes().iter().take(offset);
        before.filter(|byte| **byte == b'\n').count() + 1
    }
}
