//! Probes: pictures of ones and coordinates whose blur tells where a filter gathers.

mod origins;
mod pictures;
mod scores;

pub use pictures::Probes;
pub use scores::{OriginReference, ProbeMeasurement};
