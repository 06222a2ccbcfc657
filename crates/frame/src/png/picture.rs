//! PNG files as pictures of display values.

use std::collections::BTreeSet;
use std::path::Path;

use image::ImageFormat;

use super::palette::{MAX_COLORS, check_png_palette};
use crate::photo::{MAX_PICTURE_BYTES, decode_picture, display_values};
use crate::{FileError, Raster, read_bounded, write_atomically};

/// Reads an 8-bit or 16-bit PNG as display values in [0, 1]; grey becomes colour. Refuses a picture
/// that is not opaque, because its background is not known.
pub fn read_png(path: &Path) -> Result<Raster<[f32; 3]>, FileError> {
    let bytes = read_bounded(path, MAX_PICTURE_BYTES)?;
    let foreign = |reason: String| FileError::foreign(path, reason);
    check_png_palette(&bytes).map_err(foreign)?;
    let picture = decode_picture(path, &bytes, ImageFormat::Png)?;
    if picture.color().has_alpha() {
        let pixels = picture.to_rgba16();
        if let Some((x, y, _)) = pixels
            .enumerate_pixels()
            .find(|(_, _, pixel)| pixel[3] != u16::MAX)
        {
            return Err(foreign(format!(
                "pixel ({x}, {y}) is transparent; an opaque PNG is needed"
            )));
        }
    }
    Ok(display_values(&picture))
}

/// Encodes display values in [0, 1] (see [`display_srgb`](crate::display_srgb)) as an 8-bit PNG,
/// with a palette if they have at most 256 colours, as error maps do.
pub fn png_bytes(display: &Raster<[f32; 3]>) -> Vec<u8> {
    let values = to_eight_bits(display).into_raw();
    let (pixels, _) = values.as_chunks::<3>();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, display.width, display.height);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_filter(png::Filter::Adaptive);
    let written = match find_palette(pixels) {
        Some(palette) => {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(palette.concat());
            let index = |pixel| palette.binary_search(pixel).expect("it has all colours");
            let indices: Vec<u8> = pixels.iter().map(|pixel| index(pixel) as u8).collect();
            encode(encoder, &indices)
        }
        None => {
            encoder.set_color(png::ColorType::Rgb);
            encode(encoder, &values)
        }
    };
    written.expect("writing to memory cannot fail");
    bytes
}

fn encode(encoder: png::Encoder<&mut Vec<u8>>, values: &[u8]) -> Result<(), png::EncodingError> {
    let mut writer = encoder.write_header()?;
    writer.write_image_data(values)?;
    writer.finish()
}

/// Lists the colours of a picture in their order; none if they are too many for a palette.
fn find_palette(pixels: &[[u8; 3]]) -> Option<Vec<[u8; 3]>> {
    let mut colors = BTreeSet::new();
    for pixel in pixels {
        if colors.insert(*pixel) && colors.len() > MAX_COLORS {
            return None;
        }
    }
    Some(colors.into_iter().collect())
}

fn to_eight_bits(display: &Raster<[f32; 3]>) -> image::RgbImage {
    let values = display.pixels.iter().flatten();
    let bytes = values.map(|value| (value * 255.0 + 0.5) as u8).collect();
    image::RgbImage::from_raw(display.width, display.height, bytes)
        .expect("a raster has as many pixels as its size")
}

/// Writes display values as [`png_bytes`] encodes them.
pub fn write_png(path: &Path, display: &Raster<[f32; 3]>) -> Result<(), FileError> {
    write_atomically(path, &png_bytes(display))
}

/// Writes display values as a JPEG of high quality, for pages that show many pictures.
pub fn write_jpeg(path: &Path, display: &Raster<[f32; 3]>) -> Result<(), FileError> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 92);
    (to_eight_bits(display).write_with_encoder(encoder)).expect("writing to memory cannot fail");
    write_atomically(path, &bytes)
}

#[cfg(test)]
mod tests {
    use image::{GrayImage, ImageBuffer, Luma, Rgb, Rgba, RgbaImage};

    use super::*;

    #[test]
    fn a_png_reads_back_to_half_a_step() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ramp.png");
        let ramp = Raster::from_fn(300, 2, |x, y| {
            [x as f32 / 299.0, y as f32, 0.5 * x as f32 / 299.0]
        });
        write_png(&path, &ramp).unwrap();
        let back = read_png(&path).unwrap();
        assert_eq!((back.width, back.height), (300, 2));
        for (shown, back) in ramp.pixels.iter().zip(&back.pixels) {
            for (shown, back) in shown.iter().zip(back) {
                assert!((shown - back).abs() <= 0.5 / 255.0 + 1e-6, "{shown} {back}");
            }
        }
    }

    #[test]
    fn a_picture_of_few_colors_has_a_palette_and_reads_back() {
        let noise = |x: u32, y: u32| (x * 7919 + y * 104_729) % 251 % 16;
        let few = Raster::from_fn(64, 64, |x, y| [noise(x, y) as f32 / 15.0, 0.2, 1.0]);
        let bytes = png_bytes(&few);
        // Colour type of the header: 3, indices of a palette (PNG specification, 11.2.1).
        assert_eq!(bytes[25], 3);
        let many = Raster::from_fn(64, 64, |x, y| [x as f32 / 63.0, y as f32 / 63.0, 0.0]);
        assert_eq!(png_bytes(&many)[25], 2);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("few.png");
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(read_png(&path).unwrap().pixels, few.pixels);
    }

    #[test]
    fn pngs_of_other_kinds_are_read_if_they_are_opaque() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        let deep: ImageBuffer<Rgb<u16>, Vec<u16>> = ImageBuffer::from_pixel(2, 1, Rgb([1, 2, 3]));
        deep.save(&path).unwrap();
        let unit = f32::from(u16::MAX);
        assert_eq!(
            read_png(&path).unwrap().pixels,
            [[1.0 / unit, 2.0 / unit, 3.0 / unit]; 2]
        );
        GrayImage::from_pixel(2, 1, Luma([51])).save(&path).unwrap();
        assert_eq!(read_png(&path).unwrap().pixels, [[0.2; 3]; 2]);
        let mut glass = RgbaImage::from_pixel(2, 1, Rgba([255, 0, 0, 255]));
        glass.save(&path).unwrap();
        assert_eq!(read_png(&path).unwrap().pixels, [[1.0, 0.0, 0.0]; 2]);
        glass.put_pixel(1, 0, Rgba([255, 0, 0, 254]));
        glass.save(&path).unwrap();
        let message = read_png(&path).unwrap_err().to_string();
        assert!(message.contains("pixel (1, 0) is transparent"), "{message}");
    }
}
