//! Probes: pictures of ones and coordinates. Their blur shows where a filter gathers.

mod origins;
mod pictures;
mod scores;

pub use pictures::Probes;
pub use scores::{OriginReference, ProbeMeasurement};
