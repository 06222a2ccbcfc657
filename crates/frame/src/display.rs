//! The display transform: for pictures that people look at and for LDR metrics only.

use std::io::Cursor;
use std::path::Path;

use crate::exr_file::ExrFile;
use crate::{FileError, Image, Raster, check_png_palette, read_bounded, write_atomically};

/// Photographic exposures for pictures and for FLIP.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// Exposure of PNGs and of LDR-FLIP, in stops.
    pub stops: f32,
    /// Exposures of HDR-FLIP.
    pub flip: FlipExposures,
}

/// The range of exposures that HDR-FLIP takes its maximum over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipExposures {
    /// Darkest, in stops.
    pub start: f32,
    /// Brightest, in stops.
    pub stop: f32,
    /// How many, both ends included; at least 2.
    pub count: u32,
}

/// Stops by which an exposure of display or of FLIP may differ from none. Radiance times `2^stops` stays a number.
pub const MOST_STOPS: f32 = 32.0;

impl Display {
    /// Refuses exposures that show nothing: too many stops, a range that is none, a count that FLIP does not take.
    fn check(&self) -> Result<(), String> {
        let Self { stops, flip } = self;
        let FlipExposures { start, stop, count } = flip;
        let bounded = [stops, start, stop]
            .iter()
            .all(|value| value.abs() <= MOST_STOPS);
        if bounded && start <= stop && (2..=128).contains(count) {
            return Ok(());
        }
        Err(format!(
            "attributes display_stops, flip_start, flip_stop and flip_count hold {stops}, {start}, {stop} and {count}; \
             allowed: stops from -{MOST_STOPS} to {MOST_STOPS}, a start not above the stop, 2 to 128 exposures"
        ))
    }

    pub(crate) fn set(&self, file: &mut ExrFile) {
        file.set("display_stops", self.stops);
        file.set("flip_start", self.flip.start);
        file.set("flip_stop", self.flip.stop);
        file.set("flip_count", self.flip.count);
    }

    pub(crate) fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        let display = Self {
            stops: file.get("display_stops")?,
            flip: FlipExposures {
                start: file.get("flip_start")?,
                stop: file.get("flip_stop")?,
                count: file.get("flip_count")?,
            },
        };
        display.check().map_err(|reason| file.foreign(reason))?;
        Ok(display)
    }
}

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

/// The radiance component that an sRGB value in [0, 1] shows: [`srgb`] undone, but for what it clamped.
fn linear(srgb: f32, stops: f32) -> f32 {
    let value = if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    };
    value * (-stops).exp2()
}

/// The scene-linear image that display values in [0, 1] show: sRGB decoded, the photographic exposure of `stops`
/// undone. What lay above display white stays at display white.
pub fn scene_linear(display: &Image, stops: f32) -> Image {
    display.map(|pixel| pixel.map(|component| linear(component, stops)))
}

/// Pixels of a PNG that is read as a finished picture.
pub const MOST_PNG_PIXELS: u64 = 1 << 25;
/// Bytes of such a file: what its pixels take at most.
const MOST_PNG_BYTES: u64 = 16 * MOST_PNG_PIXELS;

/// Refuses a PNG of more than [`MOST_PNG_PIXELS`] by its header: few bytes may stand for very many pixels.
fn check_png_size(bytes: &[u8]) -> Result<(), String> {
    let reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Png);
    let (width, height) = (reader.into_dimensions())
        .map_err(|error| format!("not a PNG that can be read: {error}"))?;
    match u64::from(width) * u64::from(height) <= MOST_PNG_PIXELS {
        true => Ok(()),
        false => Err(format!(
            "claims {width}x{height} pixels; allowed: up to {MOST_PNG_PIXELS} pixels"
        )),
    }
}

/// Reads an 8-bit or 16-bit PNG as display values in [0, 1]; grey is widened to colour. What is not opaque is refused: over
/// which background it was meant is not known.
pub fn read_png(path: &Path) -> Result<Raster<[f32; 3]>, FileError> {
    let bytes = read_bounded(path, MOST_PNG_BYTES)?;
    let foreign = |reason: String| FileError::Foreign {
        path: path.to_owned(),
        reason,
    };
    check_png_size(&bytes).map_err(foreign)?;
    check_png_palette(&bytes).map_err(foreign)?;
    let picture = image::load_from_memory_with_format(&bytes, image::ImageFormat::Png)
        .map_err(|error| foreign(format!("not a PNG that can be read: {error}")))?;
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
    let pixels = picture.to_rgb16();
    Ok(Raster {
        width: pixels.width(),
        height: pixels.height(),
        pixels: (pixels.pixels())
            .map(|pixel| pixel.0.map(|value| f32::from(value) / f32::from(u16::MAX)))
            .collect(),
    })
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

#[cfg(test)]
mod tests {
    use image::{GrayImage, ImageBuffer, Luma, Rgb, Rgba, RgbaImage};

    use super::*;

    #[test]
    fn radiance_that_was_shown_comes_back_but_for_what_lay_above_white() {
        for stops in [-2.0_f32, 0.0, 1.5] {
            let white = (-stops).exp2();
            for radiance in [0.0, 0.001, 0.0031308, 0.0032, 0.18, 0.999, 1.0, 3.0] {
                let radiance = radiance * white;
                let back = linear(srgb(radiance, stops), stops);
                // A power and its inverse in 32-bit floats: a few roundings, relative to white.
                let error = (back - radiance.min(white)).abs();
                assert!(error < 1e-6 * white, "{radiance} at {stops}: {back}");
            }
        }
    }

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
