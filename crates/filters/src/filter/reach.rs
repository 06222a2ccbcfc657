//! Reach: the length along the velocity that a filter reads, and the parameter that sets it.

use serde::Deserialize;

use super::pass::Count;

/// The parameter that bounds the reach of a filter.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReachBy {
    /// An integer parameter.
    pub parameter: String,
    /// Growth of the reach with it.
    pub(crate) growth: Growth,
    /// The reach when the parameter is 1; a pixel if left out.
    #[serde(default = "one_pixel")]
    pub(crate) unit: Count,
}

fn one_pixel() -> Count {
    Count::Number(1)
}

/// Growth of the reach with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Growth {
    /// Reach = unit x value: the side of a tile.
    Linear,
    /// Reach = unit x 2^(value - 1): the steps of a flood.
    Doubling,
}
