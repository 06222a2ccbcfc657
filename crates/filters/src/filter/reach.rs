//! Reach: the length along the velocity that a filter reads, and the parameter that sets it.

/// A length in pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Length {
    /// A fixed number.
    Pixels(u32),
    /// The value of this integer parameter.
    Parameter(String),
}

/// The parameter that bounds the reach of a filter.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachBy {
    /// An integer parameter.
    pub parameter: String,
    /// Growth of the reach with it.
    pub growth: Growth,
    /// The reach when the parameter is 1.
    pub unit: Length,
}

/// Growth of the reach with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Growth {
    /// Reach = unit x value: the side of a tile.
    Linear,
    /// Reach = unit x 2^(value - 1): the steps of a flood.
    Doubling,
}
