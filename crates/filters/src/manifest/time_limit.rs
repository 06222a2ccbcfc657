//! `time_limit` of filter.toml.

use toml::Spanned;

use super::file::File;
use crate::FilterError;
use crate::filter::DEFAULT_TIME_LIMIT;

/// Greatest time limit, in seconds: a day.
const LONGEST: f64 = 86_400.0;

/// Reads the seconds that one run of a program, or one pass of kernels, may take.
pub(super) fn read_time_limit(
    file: &File,
    limit: Option<&Spanned<f64>>,
) -> Result<f64, FilterError> {
    match limit {
        None => Ok(DEFAULT_TIME_LIMIT),
        Some(limit) if *limit.get_ref() > 0.0 && *limit.get_ref() <= LONGEST => {
            Ok(*limit.get_ref())
        }
        Some(limit) => Err(file.at(
            limit,
            format!(
                "time_limit = {}; allowed: seconds, above 0 and at most {LONGEST}",
                limit.get_ref()
            ),
        )),
    }
}
