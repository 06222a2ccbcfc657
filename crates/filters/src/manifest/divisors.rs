//! `divided_by` of a [[texture]] in filter.toml.

use serde::Deserialize;

use super::file::is_identifier;
use super::parameters::check_count;
use super::reach_by::LengthEntry;
use crate::{Expression, Parameter};

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a divisor is a number of pixels or the name of an integer parameter, an expression such as \"ceil(height / 160) * 8\", or a list of two for width and height"
)]
pub(super) enum DivisorEntry {
    Both(LengthEntry),
    Each([LengthEntry; 2]),
}

/// Reads what divides the width and the height of the image.
pub(super) fn read_divisors(
    parameters: &[Parameter],
    entry: &DivisorEntry,
) -> Result<[Expression; 2], String> {
    match entry {
        DivisorEntry::Both(both) => {
            let divisor = read_divisor(parameters, both)?;
            Ok([divisor.clone(), divisor])
        }
        DivisorEntry::Each([width, height]) => Ok([
            read_divisor(parameters, width)?,
            read_divisor(parameters, height)?,
        ]),
    }
}

/// Reads a divisor: a number, an integer parameter, or an expression of parameters and of the picture's size.
fn read_divisor(parameters: &[Parameter], entry: &LengthEntry) -> Result<Expression, String> {
    let text = match entry {
        LengthEntry::Pixels(0) => return Err("0; allowed: 1 pixel or more".to_owned()),
        LengthEntry::Pixels(pixels) => return Ok(Expression::Number(f64::from(*pixels))),
        LengthEntry::Parameter(text) => text,
    };
    let is_size = |name: &str| matches!(name, "width" | "height");
    if is_identifier(text) && !is_size(text) {
        check_count(parameters, text)?;
    }
    let is_known =
        |name: &str| is_size(name) || parameters.iter().any(|parameter| parameter.name == name);
    Expression::parse(text, &is_known).map_err(|reason| {
        format!("\"{text}\" {reason}; known names: width, height, and the filter's parameters")
    })
}
