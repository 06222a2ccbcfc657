//! The display transform: for pictures that people look at and for LDR metrics only.

use std::io::Cursor;
use std::path::Path;

use crate::{FileError, Image, Raster, write_atomically};

/// One radiance component as an sRGB value in [0, 1]: scaled by `2^stops`, clamped, IEC 61966-2-1 encoded.
fn srgb(linear: f32, stops: f32) -> f32 {
    let value = (linear * stops.exp2()).clamp(0.0, 1.0);
    if value <= 0.003_130_8 {
        12.92 * value
    } else {
        1.055 * value.powf(1.0 / 2.4) - 0.055
    }
}

/// The image as a display shows it: photographic exposure of `stops`, then sRGB in [0, 1].
pub fn display_srgb(image: &Image, stops: f32) -> Image {
    image.map(|pixel| pixel.map(|component| srgb(component, stops)))
}

/// Writes display values in [0, 1] (see [`display_srgb`]) as an 8-bit PNG.
pub fn write_png(path: &Path, display: &Raster<[f32; 3]>) -> Result<(), FileError> {
    let bytes = display
        .pixels
        .iter()
        .flatten()
        .map(|value| (value * 255.0 + 0.5) as u8)
        .collect();
    let picture = image::RgbImage::from_raw(display.width, display.height, bytes)
        .expect("a raster has one pixel per pixel of its size");
    let mut png = Cursor::new(Vec::new());
    picture
        .write_to(&mut png, image::ImageFormat::Png)
        .map_err(|error| FileError::io(path, "encode", std::io::Error::other(error)))?;
    write_atomically(path, png.get_ref())
}
