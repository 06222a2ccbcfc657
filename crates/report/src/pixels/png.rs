//! Pictures that a page holds itself.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use frame::{FileError, Image, Raster, display_srgb, read_bounded, write_png};
use suite::Error;

/// Largest PNG file that a page shows, in bytes.
const MOST_PICTURE_BYTES: u64 = 1 << 28;
/// Width of a thumbnail in pixels; pictures that are narrower stay as they are.
const THUMBNAIL: u32 = 192;

/// Reads a PNG file as an address that holds the picture itself; none where there is no such file.
pub fn embed_file(path: &Path) -> Result<Option<String>, Error> {
    if !path.is_file() {
        return Ok(None);
    }
    let bytes = read_bounded(path, MOST_PICTURE_BYTES)?;
    let text = STANDARD.encode(bytes);
    Ok(Some(format!("data:image/png;base64,{text}")))
}

/// Writes display values in [0, 1] as an address that holds the picture itself.
pub fn embed_picture(display: &Raster<[f32; 3]>) -> Result<String, Error> {
    let folder = tempfile::tempdir()
        .map_err(|source| FileError::io(Path::new("a temporary folder"), "write", source))?;
    let path = folder.path().join("picture.png");
    write_png(&path, display)?;
    Ok(embed_file(&path)?.expect("it was just written"))
}

/// Shrinks an image by a whole factor and shows it at an exposure.
pub fn thumbnail(image: &Image, stops: f32) -> Image {
    let factor = (image.width / THUMBNAIL).max(1);
    let small = Raster::from_fn(
        image.width / factor,
        (image.height / factor).max(1),
        |x, y| {
            let mut sum = [0.0; 3];
            for row in 0..factor {
                for column in 0..factor {
                    let (x, y) = (
                        x * factor + column,
                        (y * factor + row).min(image.height - 1),
                    );
                    let pixel = image.at(x, y);
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += value / (factor * factor) as f32;
                    }
                }
            }
            sum
        },
    );
    display_srgb(&small, stops)
}
