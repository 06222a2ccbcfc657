//! Archives of rendered files.

mod manifest;
mod reading;
mod writing;

pub use manifest::{LARGEST_PACK_RATIO, MOST_MANIFEST_BYTES, Manifest, PACK_FORMAT, PackedFile};
pub use reading::Pack;
pub use writing::write_archive;
