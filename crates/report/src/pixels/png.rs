//! Embedded pictures of a page.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use frame::{FileError, Image, Raster, display_srgb, png_bytes, read_bounded};

/// Largest PNG file that a page shows, in bytes.
const MAX_PICTURE_BYTES: u64 = 1 << 28;
/// Width of a thumbnail in pixels; narrower pictures stay unchanged.
const THUMBNAIL: u32 = 192;

/// Reads a PNG file as an address that embeds the picture; none if there is no such file.
pub fn embed_file(path: &Path) -> Result<Option<String>, FileError> {
    if !path.is_file() {
        return Ok(None);
    }
    Ok(Some(address(&read_bounded(path, MAX_PICTURE_BYTES)?)))
}

/// Writes display values in [0, 1] as an address that embeds the picture.
pub fn embed_picture(display: &Raster<[f32; 3]>) -> String {
    address(&png_bytes(display))
}

fn address(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// Shrinks an image by a whole factor and shows it at an exposure.
pub fn thumbnail(image: &Image, stops: f32) -> Image {
    let factor = (image.width / THUMBNAIL).max(1);
    let (width, height) = (image.width / factor, (image.height / factor).max(1));
    let small = Raster::from_fn(width, height, |x, y| {
        let mut sum = [0.0; 3];
        for at in 0..factor * factor {
            let row = (y * factor + at / factor).min(image.height - 1);
            let pixel = image.at(x * factor + at % factor, row);
            for (sum, value) in sum.iter_mut().zip(pixel) {
                *sum += value / (factor * factor) as f32;
            }
        }
        sum
    });
    display_srgb(&small, stops)
}
