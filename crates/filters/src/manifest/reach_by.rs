//! `[reach_by]` of filter.toml, and lengths in pixels that a parameter may hold.

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use super::parameters::check_count;
use crate::{FilterError, Growth, Length, Parameter, ReachBy};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ReachEntry {
    parameter: String,
    growth: Growth,
    unit: Option<LengthEntry>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a length is a number of pixels or the name of an integer parameter"
)]
pub(super) enum LengthEntry {
    Pixels(u32),
    Parameter(String),
}

/// Reads the parameter that bounds the reach.
pub(super) fn read_reach_by(
    file: &File,
    entry: Option<&Spanned<ReachEntry>>,
    parameters: &[Parameter],
) -> Result<Option<ReachBy>, FilterError> {
    let Some(spanned) = entry else {
        return Ok(None);
    };
    let ReachEntry {
        parameter,
        growth,
        unit,
    } = spanned.get_ref();
    let refuse = |reason: String| file.at(spanned, format!("reach_by: {reason}"));
    check_count(parameters, parameter).map_err(|reason| refuse(format!("parameter = {reason}")))?;
    let unit = unit
        .as_ref()
        .map(|entry| read_length(parameters, entry))
        .transpose()
        .map_err(|reason| refuse(format!("unit = {reason}")))?;
    Ok(Some(ReachBy {
        parameter: parameter.clone(),
        growth: *growth,
        unit: unit.unwrap_or(Length::Pixels(1)),
    }))
}

/// Reads a length.
fn read_length(parameters: &[Parameter], entry: &LengthEntry) -> Result<Length, String> {
    match entry {
        LengthEntry::Pixels(0) => Err("0; allowed: 1 pixel or more".to_owned()),
        LengthEntry::Pixels(pixels) => Ok(Length::Pixels(*pixels)),
        LengthEntry::Parameter(parameter) => {
            check_count(parameters, parameter)?;
            Ok(Length::Parameter(parameter.clone()))
        }
    }
}
