//! Shutters: interval, alignment, and how they open and close.

mod error;
mod interval;
mod profile;

pub use error::{LONGEST_EXPOSURE, SHORTEST_EXPOSURE, ShutterError};
pub use interval::{Alignment, Shutter};
pub(crate) use interval::{get_shutter, set_shutter};
pub use profile::{Efficiency, ShutterProfile};
