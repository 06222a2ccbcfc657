//! PNG files.

mod animation;
mod palette;
mod picture;

pub use animation::write_animated_png;
pub use palette::check_png_palette;
pub use picture::{png_bytes, read_png, write_jpeg, write_png};
