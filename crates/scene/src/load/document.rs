//! The text of a scene.toml: its syntax, and the lines of its values.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::error::{SceneError, Slip, allowed_numbers, check_visible};
use crate::limits::LARGEST_NUMBER;

/// Message for the TOML parser's own limit.
const TOO_DEEP: &str = "tables and arrays are nested too deeply; allowed: up to 80 levels";

/// Text of a scene.toml.
pub(super) struct Document {
    /// File of the text.
    pub(super) path: PathBuf,
    text: String,
}

impl Document {
    pub(super) fn new(path: &Path, text: String) -> Self {
        Self {
            path: path.to_owned(),
            text,
        }
    }

    /// Makes an error about a place in the text.
    pub(super) fn error(&self, place: Range<usize>, reason: impl Into<String>) -> SceneError {
        let before = &self.text.as_bytes()[..place.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        SceneError::at_line(&self.path, line, reason)
    }

    /// Finds the line of an error.
    pub(super) fn locate(&self, slip: Slip) -> SceneError {
        self.error(slip.place, slip.reason)
    }

    /// Parses the whole text and checks its numbers and strings.
    pub(super) fn parse(&self) -> Result<DeTable<'_>, SceneError> {
        let table = DeTable::parse(&self.text).map_err(|error| self.syntax_error(&error))?;
        let table = table.into_inner();
        self.check_table(&table)?;
        Ok(table)
    }

    /// Place of the whole text.
    pub(super) fn whole(&self) -> Range<usize> {
        0..self.text.len()
    }

    /// Reads a value by its schema.
    pub(super) fn read<T: DeserializeOwned>(
        &self,
        value: Spanned<DeValue<'_>>,
    ) -> Result<T, SceneError> {
        T::deserialize(ValueDeserializer::from(value)).map_err(|error| self.syntax_error(&error))
    }

    /// Reads a value as a table; refuses any other.
    pub(super) fn expect_table<'a, 'i>(
        &self,
        what: &str,
        value: &'a Spanned<DeValue<'i>>,
    ) -> Result<&'a DeTable<'i>, SceneError> {
        match value.get_ref() {
            DeValue::Table(table) => Ok(table),
            other => {
                let reason = format!("{what} is a {}; allowed: a table", other.type_str());
                Err(self.error(value.span(), reason))
            }
        }
    }

    fn check_table(&self, table: &DeTable<'_>) -> Result<(), SceneError> {
        for (key, value) in table {
            self.check_text(key.get_ref(), key.span())?;
            self.check_value(value)?;
        }
        Ok(())
    }

    /// Checks a value and all within it; the parser limits how deeply they are nested.
    fn check_value(&self, value: &Spanned<DeValue<'_>>) -> Result<(), SceneError> {
        match value.get_ref() {
            DeValue::Float(number) => {
                self.check_number(number.as_str().parse().ok(), number, value.span())
            }
            DeValue::Integer(number) => {
                let parsed = i128::from_str_radix(number.as_str(), number.radix());
                let parsed = parsed.map_or(f64::MAX, |parsed| parsed as f64);
                self.check_number(Some(parsed), number, value.span())
            }
            DeValue::String(text) => self.check_text(text, value.span()),
            DeValue::Array(values) => values.iter().try_for_each(|value| self.check_value(value)),
            DeValue::Table(table) => self.check_table(table),
            _ => Ok(()),
        }
    }

    /// Refuses `nan` and `inf`, which TOML allows, and numbers whose squares overflow 32-bit
    /// floats.
    fn check_number(
        &self,
        parsed: Option<f64>,
        written: &dyn std::fmt::Display,
        place: Range<usize>,
    ) -> Result<(), SceneError> {
        if parsed.is_some_and(|number| number.abs() <= LARGEST_NUMBER) {
            return Ok(());
        }
        let allowed = allowed_numbers(parsed.is_some_and(f64::is_finite));
        Err(self.error(place, format!("found {written}; allowed: {allowed}")))
    }

    /// Checks a name or sentence, which may go to terminals, logs and reports.
    fn check_text(&self, text: &str, place: Range<usize>) -> Result<(), SceneError> {
        check_visible(text).map_err(|reason| self.error(place, format!("the text {reason}")))
    }

    /// Turns a parser's error into one about the file.
    fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let reason = error.message();
        let is_too_deep = reason.contains("recursion limit") || reason.contains("recurse further");
        let reason = if is_too_deep { TOO_DEEP } else { reason };
        match error.span() {
            Some(place) => self.error(place, reason),
            None => SceneError::in_file(&self.path, reason),
        }
    }
}
