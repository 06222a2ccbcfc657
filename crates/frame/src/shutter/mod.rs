//! Shutters: interval, alignment, and how they open and close.

mod error;
mod interval;
mod limits;
mod profile;

pub use error::ShutterError;
pub use interval::{Alignment, Shutter};
pub(crate) use interval::{get_shutter, set_shutter};
pub use limits::{LONGEST_EXPOSURE, SHORTEST_EXPOSURE};
pub use profile::{Efficiency, ShutterProfile};
