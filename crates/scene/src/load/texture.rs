//! Textures from PNG and JPEG files, with linear texels.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{check_png_palette, decode_srgb};
use image::ImageFormat;

use crate::Texture;
use crate::limits::{LARGEST_IMAGE_FILE, MAX_TEXELS, MAX_TEXELS_TOGETHER};

use super::files::Files;
use super::picture::Header;

/// Purpose of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Use {
    /// Colour decoded from sRGB to linear; alpha as it is.
    Color,
    /// Opacity in every texel's alpha: the image's own, or else its first component, undecoded.
    Opacity,
}

/// Textures of a scene, decoded once per file and use.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) decoded: Vec<Texture>,
    indices: BTreeMap<(PathBuf, Use), usize>,
    /// Texels of all textures together.
    texels: u64,
}

impl Textures {
    /// Loads a texture, unless it is there, and returns its index. The error is a reason alone: the
    /// caller knows the line that names the file.
    pub(super) fn load(
        &mut self,
        files: &mut Files,
        path: &Path,
        usage: Use,
    ) -> Result<usize, String> {
        let key = (path.to_owned(), usage);
        if let Some(index) = self.indices.get(&key) {
            return Ok(*index);
        }
        let name = path.display();
        let bytes = files
            .read(path, LARGEST_IMAGE_FILE)
            .map_err(|error| format!("texture {name} cannot be read: {error}"))?;
        let texture = self
            .decode(&bytes, path, usage)
            .map_err(|reason| format!("texture {name} {reason}"))?;
        let index = self.decoded.len();
        self.indices.insert(key, index);
        self.decoded.push(texture);
        Ok(index)
    }

    /// Decodes a file by its content, whatever its extension. The error follows the file's name.
    fn decode(&mut self, bytes: &[u8], path: &Path, usage: Use) -> Result<Texture, String> {
        let format = match image::guess_format(bytes) {
            Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
            _ => return Err("is neither a PNG nor a JPEG file".to_owned()),
        };
        let broken = |error| format!("is broken: {error}");
        let header = Header::read(bytes, format).map_err(broken)?;
        header.check(MAX_TEXELS)?;
        if format == ImageFormat::Png {
            check_png_palette(bytes)?;
        }
        let together = self.texels + header.texels();
        if together > MAX_TEXELS_TOGETHER {
            return Err(format!(
                "is {} x {}, which makes {together} texels of all textures together; allowed: {MAX_TEXELS_TOGETHER}; \
                 scale some of them down",
                header.width, header.height
            ));
        }
        let image = header.decode().map_err(broken)?;
        let has_alpha = image.color().has_alpha();
        // 16 bits represent files of 8 and 16 bits exactly: 8-bit values times 257.
        let image = image.into_rgba16();
        let (width, height) = image.dimensions();
        self.texels = together;
        Ok(Texture {
            path: path.to_owned(),
            width,
            height,
            texels: image
                .pixels()
                .map(|pixel| decode_texel(pixel.0, usage, has_alpha))
                .collect(),
        })
    }
}

/// Decodes a texel.
fn decode_texel(encoded: [u16; 4], usage: Use, has_alpha: bool) -> [f32; 4] {
    let [r, g, b, a] = encoded.map(|component| f32::from(component) / 65535.0);
    let alpha = match usage {
        Use::Opacity if !has_alpha => r,
        Use::Color | Use::Opacity => a,
    };
    [decode_srgb(r), decode_srgb(g), decode_srgb(b), alpha]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_are_counted_together() {
        let mut two = std::io::Cursor::new(Vec::new());
        image::GrayImage::new(2, 1)
            .write_to(&mut two, ImageFormat::Png)
            .unwrap();
        let load = |texels| {
            let mut textures = Textures {
                texels,
                ..Textures::default()
            };
            let texture = textures.decode(two.get_ref(), Path::new("two.png"), Use::Color);
            texture.map(|texture| texture.texels.len())
        };
        assert_eq!(load(MAX_TEXELS_TOGETHER - 2), Ok(2));
        let refusal = load(MAX_TEXELS_TOGETHER - 1).unwrap_err();
        assert!(
            refusal.ends_with(
                "texels of all textures together; allowed: 134217728; scale some of them down"
            ),
            "{refusal}"
        );
    }
}
