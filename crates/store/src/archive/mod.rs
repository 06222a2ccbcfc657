//! Archives of rendered files.

mod manifest;
mod reading;
mod writing;

pub use manifest::{Manifest, PACK_FORMAT, PackedFile};
pub use reading::Pack;
pub use writing::write_archive;
