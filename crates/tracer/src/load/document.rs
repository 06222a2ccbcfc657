//! The text of a scene.toml: its syntax, and the lines that its values stand in.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::error::{SceneError, hidden};
use crate::limits::LARGEST_NUMBER;

/// A scene.toml as text.
pub(super) struct Document {
    /// The file.
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

    /// An error at a place in the text.
    pub(super) fn error(&self, place: Range<usize>, reason: impl Into<String>) -> SceneError {
        let before = &self.text.as_bytes()[..place.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        SceneError::line(&self.path, line, reason)
    }

    /// The whole text as a table of checked numbers and words.
    pub(super) fn table(&self) -> Result<DeTable<'_>, SceneError> {
        let table = DeTable::parse(&self.text).map_err(|error| self.syntax_error(&error))?;
        let table = table.into_inner();
        self.check_table(&table)?;
        Ok(table)
    }

    /// The whole text's place.
    pub(super) fn whole(&self) -> Range<usize> {
        0..self.text.len()
    }

    /// A part of the text as what the schema says it is.
    pub(super) fn read<T: DeserializeOwned>(
        &self,
        value: Spanned<DeValue<'_>>,
    ) -> Result<T, SceneError> {
        T::deserialize(ValueDeserializer::from(value)).map_err(|error| self.syntax_error(&error))
    }

    /// A part of the text that must be a table.
    pub(super) fn as_table<'a, 'i>(
        &self,
        what: &str,
        value: &'a Spanned<DeValue<'i>>,
    ) -> Result<&'a DeTable<'i>, SceneError> {
        match value.get_ref() {
            DeValue::Table(table) => Ok(table),
            other => {
                let reason = format!("{what} is a {}; a table is needed", other.type_str());
                Err(self.error(value.span(), reason))
            }
        }
    }

    fn check_table(&self, table: &DeTable<'_>) -> Result<(), SceneError> {
        for (key, value) in table {
            self.check_word(key.get_ref(), key.span())?;
            self.check_value(value)?;
        }
        Ok(())
    }

    /// The parser bounds how deep values lie in one another.
    fn check_value(&self, value: &Spanned<DeValue<'_>>) -> Result<(), SceneError> {
        match value.get_ref() {
            DeValue::Float(number) => {
                self.check_number(number.as_str().parse().ok(), number, value.span())
            }
            DeValue::Integer(number) => {
                let parsed = i128::from_str_radix(number.as_str(), number.radix());
                self.check_number(
                    Some(parsed.map_or(f64::MAX, |parsed| parsed as f64)),
                    number,
                    value.span(),
                )
            }
            DeValue::String(word) => self.check_word(word, value.span()),
            DeValue::Array(values) => values.iter().try_for_each(|value| self.check_value(value)),
            DeValue::Table(table) => self.check_table(table),
            _ => Ok(()),
        }
    }

    /// TOML can write `nan` and `inf`; a scene cannot use them anywhere, nor what a 32-bit number cannot hold the square of.
    fn check_number(
        &self,
        parsed: Option<f64>,
        written: &dyn std::fmt::Display,
        place: Range<usize>,
    ) -> Result<(), SceneError> {
        let allowed = match parsed {
            Some(number) if number.abs() <= LARGEST_NUMBER => return Ok(()),
            Some(number) if number.is_finite() => {
                format!("numbers from -{LARGEST_NUMBER:e} to {LARGEST_NUMBER:e}")
            }
            _ => "finite numbers".to_owned(),
        };
        Err(self.error(place, format!("found {written}; allowed: {allowed}")))
    }

    /// Names and sentences reach terminals, logs and reports.
    fn check_word(&self, word: &str, place: Range<usize>) -> Result<(), SceneError> {
        match hidden(word) {
            Some(reason) => Err(self.error(place, format!("the text {reason}"))),
            None => Ok(()),
        }
    }

    /// serde speaks of fields, variants and types of Rust; a scene has keys, families and numbers.
    pub(super) fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let reason = error
            .message()
            .replace("unknown field", "unknown key")
            .replace("missing field", "missing key")
            .replace("duplicate field", "duplicate key")
            .replace("unknown variant", "unknown family")
            .replace("expected f64", "expected a number")
            .replace("expected f32", "expected a number")
            .replace("expected u32", "expected a whole number from 0")
            .replace("expected one of", "allowed:")
            .replace("expected", "allowed:");
        match error.span() {
            Some(place) => self.error(place, reason),
            None => SceneError::file(&self.path, reason),
        }
    }
}
