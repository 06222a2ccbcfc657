//! Environment maps from EXR and HDR files.

use std::io::Cursor;
use std::path::Path;

use frame::decode_exr;
use image::ImageFormat;

use super::files::Files;
use super::picture::Header;
use crate::EnvironmentMap;
use crate::limits::{
    BRIGHTEST, LARGEST_IMAGE_FILE, MAX_ENVIRONMENT_TEXELS, MAX_ENVIRONMENT_VALUES,
};

/// Reads a map with strength 1 and rotation 0. The error is a reason alone: the caller knows the
/// line that names the file.
pub(super) fn read_map(files: &mut Files, path: &Path) -> Result<EnvironmentMap, String> {
    let name = path.display();
    let format = match path.extension().and_then(|extension| extension.to_str()) {
        Some("exr") => ImageFormat::OpenExr,
        Some("hdr") => ImageFormat::Hdr,
        _ => {
            return Err(format!(
                "the background's image {name} is neither .exr nor .hdr; other formats do not hold radiance"
            ));
        }
    };
    let bytes = files
        .read(path, LARGEST_IMAGE_FILE)
        .map_err(|error| format!("the background's image {name} cannot be read: {error}"))?;
    decode(&bytes, path, format).map_err(|reason| format!("the background's image {name} {reason}"))
}

/// Decodes a map. The error follows the file's name.
fn decode(bytes: &[u8], path: &Path, format: ImageFormat) -> Result<EnvironmentMap, String> {
    let undecodable = |error: String| format!("cannot be decoded: {error}");
    let header = Header::read(bytes, format).map_err(undecodable)?;
    header.check(MAX_ENVIRONMENT_TEXELS)?;
    if u64::from(header.width) != 2 * u64::from(header.height) {
        return Err(format!(
            "is {} x {}; allowed: a map in longitude and latitude, twice as wide as high",
            header.width, header.height
        ));
    }
    let (width, height) = (header.width, header.height);
    let texels: Vec<[f32; 3]> = if format == ImageFormat::OpenExr {
        check_exr_values(bytes)?;
        read_exr_colors(bytes, path)?
    } else {
        let image = header.decode().map_err(undecodable)?.into_rgb32f();
        image.pixels().map(|pixel| pixel.0).collect()
    };
    let is_wrong = |texel: &[f32; 3]| !texel.iter().all(|part| (0.0..=BRIGHTEST).contains(part));
    if let Some(index) = texels.iter().position(is_wrong) {
        let [x, y] = [index % width as usize, index / width as usize];
        return Err(format!(
            "holds {:?} at ({x}, {y}); allowed: 0 to {BRIGHTEST:e}",
            texels[index]
        ));
    }
    Ok(EnvironmentMap {
        path: path.to_owned(),
        width,
        height,
        texels,
        strength: 1.0,
        rotation: 0.0,
    })
}

/// Reads the colours of an EXR file as any picture's: in Rec.709, from a whole picture.
fn read_exr_colors(bytes: &[u8], path: &Path) -> Result<Vec<[f32; 3]>, String> {
    let read = || {
        let file = decode_exr(bytes, path)?;
        file.expect_plain_pixels()?;
        file.color("")
    };
    let color = read().map_err(|error| format!("cannot be used: {}", error.reason()))?;
    Ok(color.pixels)
}

/// Limits all values of an EXR file: the decoder reads every channel and layer, and pixels outside
/// the picture.
fn check_exr_values(bytes: &[u8]) -> Result<(), String> {
    let file = exr::block::read(Cursor::new(bytes), false)
        .map_err(|error| format!("cannot be decoded: {error}"))?;
    let count = |layer: &exr::meta::header::Header| {
        let texels = layer.layer_size.width() as u64 * layer.layer_size.height() as u64;
        texels.saturating_mul(layer.channels.list.len() as u64)
    };
    let values = (file.headers().iter().map(count)).fold(0, u64::saturating_add);
    if values > MAX_ENVIRONMENT_VALUES {
        return Err(format!(
            "holds {values} values in all its channels and layers; allowed: {MAX_ENVIRONMENT_VALUES}; scale it down, \
             or save only R, G and B"
        ));
    }
    Ok(())
}
