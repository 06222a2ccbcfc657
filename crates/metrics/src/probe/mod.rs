//! Probes: pictures of ones and coordinates. Their blur shows where a filter gathers.

mod mixture;
mod origins;
mod packing;
mod pictures;
mod scores;

pub use mixture::{mix, nonlinearity};
pub use packing::{pack_planes, unpack_planes};
pub use pictures::Probes;
pub use scores::{OriginReference, ProbeMeasurement};
