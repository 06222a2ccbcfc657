//! Files of any kind: whole and safe reading and writing.

mod error;
mod reading;
mod writing;

pub use error::FileError;
pub use reading::{open_regular, read_bounded};
pub use writing::{remove_leftovers, write_atomically, write_streamed};
