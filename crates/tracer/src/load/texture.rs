//! PNG and JPEG files as linear texels.

use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageFormat};

use crate::Texture;

use super::files::Files;

/// What a texture is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    /// Colour decoded from sRGB to linear; alpha as it is.
    Color,
    /// Opacity in every texel's alpha: the image's own, or else its first component, undecoded.
    Opacity,
}

/// Textures, each file and use decoded once.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) decoded: Vec<Texture>,
    keys: Vec<(PathBuf, Use)>,
}

impl Textures {
    /// Index of a texture; the error is the reason alone, for the caller knows the place that names the file.
    pub(super) fn load(
        &mut self,
        files: &mut Files,
        path: &Path,
        usage: Use,
    ) -> Result<usize, String> {
        let key = (path.to_owned(), usage);
        if let Some(index) = self.keys.iter().position(|known| *known == key) {
            return Ok(index);
        }
        let bytes = files
            .bytes(path)
            .map_err(|error| format!("texture {} cannot be read: {error}", path.display()))?;
        let image =
            decode(&bytes).map_err(|reason| format!("texture {} {reason}", path.display()))?;
        let has_alpha = image.color().has_alpha();
        // 16 bits hold 8-bit and 16-bit files alike: 8-bit values are spread by 257, exactly.
        let image = image.into_rgba16();
        let (width, height) = image.dimensions();
        let texels = image
            .pixels()
            .map(|pixel| texel(pixel.0, usage, has_alpha))
            .collect();
        self.keys.push(key);
        self.decoded.push(Texture {
            path: path.to_owned(),
            width,
            height,
            texels,
        });
        Ok(self.decoded.len() - 1)
    }
}

/// Whatever the name ends in; the error is a reason that follows the file's name.
fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => {
            image::load_from_memory_with_format(bytes, format)
                .map_err(|error| format!("is broken: {error}"))
        }
        _ => Err("is neither a PNG nor a JPEG file".to_owned()),
    }
}

fn texel(encoded: [u16; 4], usage: Use, has_alpha: bool) -> [f32; 4] {
    let [r, g, b, a] = encoded.map(|component| f32::from(component) / 65535.0);
    let alpha = match usage {
        Use::Opacity if !has_alpha => r,
        Use::Color | Use::Opacity => a,
    };
    [linear(r), linear(g), linear(b), alpha]
}

/// IEC 61966-2-1.
fn linear(encoded: f32) -> f32 {
    if encoded <= 0.040_45 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}
