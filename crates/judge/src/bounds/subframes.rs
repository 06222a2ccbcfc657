//! Limits on equivalent sub-frames, for which ladders have to be rendered.

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
            (of_filter.keys()).any(|metric| matches!(metric, Metric::Equivalent(_)))
        })
    })
}
