//! Limits on exposures.

/// The shortest exposure, in frames.
pub const SHORTEST_EXPOSURE: f64 = 1e-9;
/// The longest exposure, in frames.
pub const LONGEST_EXPOSURE: f64 = 1e4;
