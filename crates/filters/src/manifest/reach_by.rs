//! `[reach_by]` of filter.toml.

use toml::Spanned;

use super::file::File;
use super::number::Names;
use crate::{FilterError, Length, ReachBy};

/// Refuses a reach that does not come from integer parameters.
pub(super) fn check_reach_by(
    file: &File,
    spanned: &Spanned<ReachBy>,
    names: Names,
) -> Result<(), FilterError> {
    let ReachBy {
        parameter, unit, ..
    } = spanned.get_ref();
    let unit = match unit {
        Length::Pixels(0) => Err("0; allowed: 1 pixel or more".to_owned()),
        Length::Pixels(_) => Ok(()),
        Length::Parameter(parameter) => names.check_count(parameter),
    };
    let parameter = names.check_count(parameter);
    parameter
        .map_err(|reason| format!("parameter = {reason}"))
        .and(unit.map_err(|reason| format!("unit = {reason}")))
        .map_err(|reason| file.at(spanned, format!("reach_by: {reason}")))
}
