//! Numbers of filter.toml that may be expressions, and the names that these may have.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::filter::explain_unknown;
use crate::{Count, Expression, Filter, Kind};

/// A number, or a text with an expression.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a text with an expression")]
pub(super) enum NumberEntry {
    Number(f64),
    Text(String),
}

/// One number, or several.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a value is a number, a text with an expression, or a list of these"
)]
pub(super) enum NumbersEntry {
    One(NumberEntry),
    Several(Vec<NumberEntry>),
    /// Those of the members of a struct.
    Members(BTreeMap<String, NumbersEntry>),
}

impl NumbersEntry {
    pub fn as_slice(&self) -> &[NumberEntry] {
        match self {
            Self::One(number) => std::slice::from_ref(number),
            Self::Several(numbers) => numbers,
            Self::Members(_) => &[],
        }
    }
}

impl Filter {
    fn is_parameter(&self, name: &str) -> bool {
        self.parameters.iter().any(|known| known.name == name)
    }

    /// Returns true for a parameter or a value of the convention.
    fn is_setting(&self, name: &str) -> bool {
        self.is_parameter(name) || self.convention.value(name).is_some()
    }

    /// Reads a value of a uniform block: a number, an expression, or the name of several numbers.
    pub(super) fn read_value(&self, entry: &NumberEntry) -> Result<Expression, String> {
        if let NumberEntry::Text(text) = entry {
            if self.count_numbers(text.trim()).is_some() {
                return Ok(Expression::Name(text.trim().to_owned()));
            }
            if let Some(reason) = explain_unknown(text.trim()) {
                return Err(format!("\"{text}\" {reason}"));
            }
        }
        read(entry, &|name| self.count_numbers(name) == Some(1), || {
            format!(
                "known names: {}; arithmetic takes one of several numbers, such as resolution[0]",
                self.list_values()
            )
        })
    }

    /// Reads the value of a specialisation constant: a number, or an expression of parameters.
    pub(super) fn read_constant(&self, entry: &NumberEntry) -> Result<Expression, String> {
        read(entry, &|name| self.is_setting(name), || {
            "allowed: numbers, parameters, and values of [convention]".into()
        })
    }

    /// Reads the mip level of a texture: a number from 0, or an expression of parameters and of the
    /// iteration.
    pub(super) fn read_level(&self, entry: &NumberEntry) -> Result<Expression, String> {
        let of_run = ["iteration", "iterations"];
        match entry {
            NumberEntry::Number(level) if *level < 0.0 || level.fract() != 0.0 => {
                Err(format!("{level}; allowed: whole, from 0"))
            }
            entry => {
                let is_known = |name: &str| self.is_setting(name) || of_run.contains(&name);
                read(entry, &is_known, || {
                    let of_run = of_run.join(", ");
                    format!("known names: parameters, values of [convention], {of_run}")
                })
            }
        }
    }

    /// Reads the divisor of a side of the image: a number, an integer parameter, or an expression
    /// of parameters and of the picture's size.
    pub(super) fn read_divisor(&self, entry: &NumberEntry) -> Result<Expression, String> {
        let is_size = |name: &str| matches!(name, "width" | "height");
        match entry {
            NumberEntry::Number(pixels) if *pixels < 1.0 || pixels.fract() != 0.0 => {
                return Err(format!(
                    "{pixels}; allowed: 1 pixel or more, as a number of pixels or the name of an integer parameter, or an \
                     expression such as \"ceil(height / 160) * 8\""
                ));
            }
            NumberEntry::Text(text) if is_identifier(text) && !is_size(text) => {
                self.check_parameter(text)?;
            }
            _ => {}
        }
        let is_known = |name: &str| is_size(name) || self.is_parameter(name);
        read(entry, &is_known, || {
            "known names: width, height, and the filter's parameters".into()
        })
    }

    /// Finds the largest value of a count or a length. Refuses 0, and a name that is not an integer
    /// parameter from 1.
    pub(super) fn find_largest(&self, count: &Count) -> Result<u32, String> {
        match count {
            Count::Number(0) => Err("0; allowed: 1 or more".into()),
            Count::Number(number) => Ok(*number),
            Count::Parameter(name) => self.check_parameter(name),
        }
    }

    /// Returns the largest value of an integer parameter; refuses any other name, and a range that
    /// begins below 1.
    pub(super) fn check_parameter(&self, name: &str) -> Result<u32, String> {
        let parameter = self.parameters.iter().find(|known| known.name == name);
        match parameter.map(|parameter| &parameter.kind) {
            None => Err(format!("\"{name}\" is no parameter of this filter")),
            Some(Kind::Integer { min, max, .. }) if *min >= 1 => Ok(max.unsigned_abs()),
            Some(_) => Err(format!(
                "\"{name}\" is not an integer parameter with a range from 1 or more"
            )),
        }
    }
}

/// Rule for names, as messages say it.
pub(super) const IDENTIFIER: &str = "a name is made of a-z, 0-9 and _, and begins with a letter";

/// Returns true for a name that obeys [`IDENTIFIER`].
pub(super) fn is_identifier(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// Checks the name of a filter.
///
/// # Errors
/// The name is none that filter.toml may have; says the rule.
pub fn check_filter_name(name: &str) -> Result<(), String> {
    if is_identifier(name) {
        Ok(())
    } else {
        Err(format!("the name \"{name}\": {IDENTIFIER}"))
    }
}

/// Reads a finite number, or an expression of known names. The error begins with what was found.
fn read(
    entry: &NumberEntry,
    is_known: &dyn Fn(&str) -> bool,
    allowed: impl Fn() -> String,
) -> Result<Expression, String> {
    match entry {
        NumberEntry::Number(number) if number.is_finite() => Ok(Expression::Number(*number)),
        NumberEntry::Number(number) => Err(format!("{number}; allowed: finite")),
        NumberEntry::Text(text) => Expression::parse(text, is_known)
            .map_err(|reason| format!("\"{text}\" {reason}; {}", allowed())),
    }
}
