//! PNG textures.

use std::io::Cursor;

/// Encodes an 8-bit PNG of `size` x `size` texels from `color(x, y)`, sRGB components in [0, 1]
/// with (0, 0) at the top left.
pub(crate) fn encode_png(size: u32, color: impl Fn(u32, u32) -> [f64; 3]) -> Vec<u8> {
    let picture = image::RgbImage::from_fn(size, size, |x, y| {
        image::Rgb(color(x, y).map(|component| (component * 255.0).round() as u8))
    });
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a PNG can be written to memory");
    bytes.into_inner()
}
