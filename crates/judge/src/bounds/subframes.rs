//! Limits on equivalent sub-frames, for which ladders have to be rendered.

use std::str::FromStr;

use metrics::Metric;
use suite::FilterChoice;

use crate::bounds::SceneBounds;

/// Tells whether any of the scenes has a limit on equivalent sub-frames of any of the filters.
pub fn bound_subframes<'a>(
    mut scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &[FilterChoice],
) -> bool {
    scenes.any(|bounds| {
        filters.iter().any(|choice| {
            let of_filter = bounds.of(&choice.filter.name, &choice.preset);
            of_filter.keys().any(|name| is_of_subframes(name))
        })
    })
}

/// Tells whether a name is that of a metric of equivalent sub-frames.
pub fn is_of_subframes(metric: &str) -> bool {
    matches!(Metric::from_str(metric), Ok(Metric::Equivalent(_)))
}
