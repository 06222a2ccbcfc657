//! Trial of filters of the user's own, before they are listed.

use filters::{Filter, FilterError, Limits, try_out};
use suite::{Error, open_adapter};

use crate::output::{make_silent_monitor, print_note};

/// Holds kernels to the adapter's limits and runs them with every preset and at both ends of every range. Without an adapter,
/// holds them to the lowest common limits, and says so.
pub fn try_filters(filters: &[Filter], adapter: Option<&str>) -> Result<(), Error> {
    let have_kernels = filters.iter().any(|filter| filter.command.is_none());
    if !have_kernels && adapter.is_none() {
        return Ok(());
    }
    match open_adapter(adapter, make_silent_monitor()) {
        Ok(gpu) => {
            let limits = Limits::of(&gpu);
            for filter in filters {
                limits.check(filter)?;
                try_out(&gpu, filter)?;
            }
        }
        Err(FilterError::NoAdapter) => {
            let limits = Limits::lowest();
            for filter in filters {
                limits.check(filter)?;
            }
            print_note(
                "no GPU adapter was found: kernels were held to the lowest common limits, and no preset or range was tried",
            );
        }
        Err(error) => return Err(error.into()),
    }
    for filter in filters {
        if let Err(error) = Limits::lowest().check(filter) {
            print_note(&format!("other adapters may refuse this filter: {error}"));
        }
    }
    Ok(())
}
