//! EXR and HDR files as environment maps.

use std::path::Path;

use image::ImageFormat;

use super::files::Files;
use crate::EnvironmentMap;

/// Reads a map, neither strengthened nor turned; the error is the reason alone, for the caller knows the place that
/// names the file.
pub(super) fn load(files: &mut Files, path: &Path) -> Result<EnvironmentMap, String> {
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
        .bytes(path)
        .map_err(|error| format!("the background's image {name} cannot be read: {error}"))?;
    let image = image::load_from_memory_with_format(&bytes, format)
        .map_err(|error| format!("the background's image {name} cannot be decoded: {error}"))?
        .into_rgb32f();
    let (width, height) = image.dimensions();
    if width != 2 * height {
        return Err(format!(
            "the background's image {name} is {width} x {height}; allowed: a map in longitude and latitude, twice as wide as high"
        ));
    }
    let texels: Vec<[f32; 3]> = image.pixels().map(|pixel| pixel.0).collect();
    let amiss = |texel: &[f32; 3]| !texel.iter().all(|part| part.is_finite() && *part >= 0.0);
    if let Some(index) = texels.iter().position(amiss) {
        let [x, y] = [index % width as usize, index / width as usize];
        return Err(format!(
            "the background's image {name} holds {:?} at ({x}, {y}); allowed: 0 and above, finite",
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
