//! OpenEXR files.

mod check;
mod colors;
mod file;
mod header;
mod passes;
mod reading;
mod writing;

pub use colors::ColorMeaning;
pub(crate) use file::in_layer;
pub use file::{Channel, ExrFile, Samples};
pub use header::{LARGEST_EXR_RATIO, LARGEST_EXR_SIDE, MAX_EXR_BYTES, MAX_EXR_CHANNELS};
pub use passes::read_passes;
pub use reading::{
    ExrClaims, decode_exr, read_attribute, read_exr, read_exr_claims, read_exr_header,
};
pub use writing::{write_exr, write_half_exr, write_small_exr};
