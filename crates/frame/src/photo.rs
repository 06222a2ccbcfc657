//! Files of pictures from elsewhere: their decoding within limits, JPEG and Radiance HDR.

use std::io::Cursor;
use std::path::Path;

use image::metadata::Orientation;
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader};

use crate::{FileError, Image, Raster, read_bounded};

/// Upper limit on the pixels of a PNG, JPEG or HDR file that is read as a picture.
pub const MAX_PICTURE_PIXELS: u64 = 1 << 25;
/// Upper limit on the bytes of such a file: the most that its pixels take.
pub(crate) const MAX_PICTURE_BYTES: u64 = 16 * MAX_PICTURE_PIXELS;

/// Decodes a picture. Refuses one of more than [`MAX_PICTURE_PIXELS`] by its header, since few
/// bytes may encode very many pixels, and one that must be turned to be looked at.
pub(crate) fn decode_picture(
    path: &Path,
    bytes: &[u8],
    format: ImageFormat,
) -> Result<DynamicImage, FileError> {
    let foreign = |reason: String| FileError::foreign(path, reason);
    let unreadable = |error: image::ImageError| {
        let name = match format {
            ImageFormat::Png => "a PNG",
            ImageFormat::Jpeg => "a JPEG",
            _ => "a Radiance HDR file",
        };
        foreign(format!("not {name} that can be read: {error}"))
    };
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut decoder = reader.into_decoder().map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MAX_PICTURE_PIXELS {
        return Err(foreign(format!(
            "claims {width}x{height} pixels; allowed: up to {MAX_PICTURE_PIXELS} pixels"
        )));
    }
    if decoder.orientation().map_err(unreadable)? != Orientation::NoTransforms {
        return Err(foreign(
            "asks in its EXIF data to be turned before it is shown; save it with its pixels turned"
                .to_owned(),
        ));
    }
    DynamicImage::from_decoder(decoder).map_err(unreadable)
}

/// Returns display values in [0, 1]; grey becomes colour.
pub(crate) fn display_values(picture: &DynamicImage) -> Raster<[f32; 3]> {
    let pixels = picture.to_rgb16();
    Raster {
        width: pixels.width(),
        height: pixels.height(),
        pixels: (pixels.pixels())
            .map(|pixel| pixel.0.map(|value| f32::from(value) / f32::from(u16::MAX)))
            .collect(),
    }
}

/// Reads a JPEG as display values in [0, 1]; grey becomes colour.
pub fn read_jpeg(path: &Path) -> Result<Raster<[f32; 3]>, FileError> {
    let bytes = read_bounded(path, MAX_PICTURE_BYTES)?;
    let picture = decode_picture(path, &bytes, ImageFormat::Jpeg)?;
    Ok(display_values(&picture))
}

/// Reads a Radiance HDR file as scene-linear radiance.
pub fn read_hdr(path: &Path) -> Result<Image, FileError> {
    let bytes = read_bounded(path, MAX_PICTURE_BYTES)?;
    let pixels = decode_picture(path, &bytes, ImageFormat::Hdr)?.into_rgb32f();
    Ok(Raster {
        width: pixels.width(),
        height: pixels.height(),
        pixels: pixels.pixels().map(|pixel| pixel.0).collect(),
    })
}

/// Reads how many bits each channel of a PNG has: 16, or 8 for it and fewer.
pub fn read_png_bits(path: &Path) -> Result<u8, FileError> {
    let bytes = read_bounded(path, MAX_PICTURE_BYTES)?;
    let reader = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Png);
    let decoder = reader.into_decoder().map_err(|error| {
        FileError::foreign(path, format!("not a PNG that can be read: {error}"))
    })?;
    Ok(match decoder.color_type() {
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => 16,
        _ => 8,
    })
}

#[cfg(test)]
mod tests {
    use image::{ImageBuffer, Rgb, RgbImage};

    use super::*;

    #[test]
    fn a_jpeg_reads_as_display_values() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("grey.jpg");
        RgbImage::from_pixel(16, 8, Rgb([51; 3]))
            .save(&path)
            .unwrap();
        let picture = read_jpeg(&path).unwrap();
        assert_eq!((picture.width, picture.height), (16, 8));
        // A flat block survives the compression but for a step.
        for value in picture.pixels.as_flattened() {
            assert!((value - 0.2).abs() <= 1.0 / 255.0 + 1e-6, "{value}");
        }
        let message = read_hdr(&path).unwrap_err().to_string();
        assert!(message.contains("not a Radiance HDR file"), "{message}");
    }

    #[test]
    fn a_jpeg_that_must_be_turned_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("turned.jpg");
        RgbImage::new(16, 8).save(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        // An APP1 segment after the start of the image: EXIF, big-endian, orientation 6.
        let exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
        let length = (exif.len() as u16 + 2).to_be_bytes();
        let turned = [&bytes[..2], &[0xff, 0xe1], &length, exif, &bytes[2..]].concat();
        std::fs::write(&path, turned).unwrap();
        let message = read_jpeg(&path).unwrap_err().to_string();
        assert!(
            message.contains("asks in its EXIF data to be turned"),
            "{message}"
        );
    }

    #[test]
    fn radiance_above_white_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bright.hdr");
        let picture: ImageBuffer<Rgb<f32>, Vec<f32>> =
            ImageBuffer::from_pixel(9, 2, Rgb([4.0, 0.5, 0.25]));
        picture.save(&path).unwrap();
        assert_eq!(read_hdr(&path).unwrap().pixels, [[4.0, 0.5, 0.25]; 18]);
    }

    #[test]
    fn the_bits_of_a_png_are_those_of_a_channel() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        let deep: ImageBuffer<Rgb<u16>, Vec<u16>> = ImageBuffer::new(2, 1);
        deep.save(&path).unwrap();
        assert_eq!(read_png_bits(&path).unwrap(), 16);
        RgbImage::new(2, 1).save(&path).unwrap();
        assert_eq!(read_png_bits(&path).unwrap(), 8);
    }
}
