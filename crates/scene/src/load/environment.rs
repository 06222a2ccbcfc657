//! Environment maps from EXR and HDR files.

use std::path::Path;

use frame::{decode_exr, read_exr_claims};
use image::ImageFormat;

use super::files::Files;
use super::picture::{Header, check_size};
use crate::EnvironmentMap;
use crate::limits::{
    BRIGHTEST, LARGEST_IMAGE_FILE, MAX_ENVIRONMENT_TEXELS, MAX_ENVIRONMENT_VALUES,
};

/// Formats of maps.
#[derive(Clone, Copy)]
enum Format {
    OpenExr,
    Hdr,
}

/// Reads a map with strength 1 and rotation 0. The error is a reason alone: the caller knows the
/// line that names the file.
pub(super) fn read_map(files: &mut Files, path: &Path) -> Result<EnvironmentMap, String> {
    let name = path.display();
    let format = match path.extension().and_then(|extension| extension.to_str()) {
        Some("exr") => Format::OpenExr,
        Some("hdr") => Format::Hdr,
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
fn decode(bytes: &[u8], path: &Path, format: Format) -> Result<EnvironmentMap, String> {
    let ([width, height], texels) = match format {
        Format::OpenExr => decode_open_exr(bytes, path)?,
        Format::Hdr => decode_hdr(bytes)?,
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

type Texels = ([u32; 2], Vec<[f32; 3]>);

/// Decodes an EXR file as any picture: in Rec.709, from a whole picture. Limits all its values: the
/// decoder reads every channel and layer, and pixels outside the picture.
fn decode_open_exr(bytes: &[u8], path: &Path) -> Result<Texels, String> {
    let claims = read_exr_claims(bytes, path)
        .map_err(|error| format!("cannot be decoded: {}", error.reason()))?;
    check_map(claims.size)?;
    let values = claims.values;
    if values > MAX_ENVIRONMENT_VALUES {
        return Err(format!(
            "holds {values} values in all its channels and layers; allowed: {MAX_ENVIRONMENT_VALUES}; scale it down, \
             or save only R, G and B"
        ));
    }
    let read = || {
        let file = decode_exr(bytes, path)?;
        file.expect_plain_pixels()?;
        file.color("")
    };
    let color = read().map_err(|error| format!("cannot be used: {}", error.reason()))?;
    Ok(([color.width, color.height], color.pixels))
}

fn decode_hdr(bytes: &[u8]) -> Result<Texels, String> {
    let undecodable = |error: String| format!("cannot be decoded: {error}");
    let header = Header::read(bytes, ImageFormat::Hdr).map_err(undecodable)?;
    let size = [header.width, header.height];
    check_map(size.map(u64::from))?;
    let image = header.decode().map_err(undecodable)?.into_rgb32f();
    Ok((size, image.pixels().map(|pixel| pixel.0).collect()))
}

/// Refuses a map of too many texels, and of another shape than that of longitude and latitude.
fn check_map(size: [u64; 2]) -> Result<(), String> {
    check_size(size, MAX_ENVIRONMENT_TEXELS)?;
    let [width, height] = size;
    if width != 2 * height {
        return Err(format!(
            "is {width} x {height}; allowed: a map in longitude and latitude, twice as wide as high"
        ));
    }
    Ok(())
}
