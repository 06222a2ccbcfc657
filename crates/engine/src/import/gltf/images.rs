//! Textures of a file: their pictures, copied into the scene's folder.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use frame::write_atomically;
use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use measure::Error;
use scene::limits::MAX_TEXELS;

use super::extensions::{refuse_removable, removable_extension};
use super::file::File;
use super::material_schema::TextureInfo;
use crate::files::{refusal, refuse};

/// Folder of the pictures, next to the MTL file.
const FOLDER: &str = "textures";

/// Beginning of a KTX2 file.
const KTX2: &[u8] = b"\xabKTX 20";

/// A picture in the scene's folder.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Path below the MTL file's folder.
    pub name: String,
    /// Mean red, green, blue and alpha, from 0 to 1, undecoded.
    pub mean: [f32; 4],
    /// Smallest alpha.
    pub least_alpha: f32,
    /// True if sampled by the nearest texel.
    pub is_nearest: bool,
    /// True if it does not repeat.
    pub is_clamped: bool,
}

/// Pictures copied so far.
pub struct Images<'a> {
    file: &'a File,
    folder: PathBuf,
    known: BTreeMap<usize, Picture>,
    /// Remapped opacities so far.
    opacities: usize,
}

impl<'a> Images<'a> {
    pub fn new(file: &'a File, folder: &Path) -> Self {
        Self {
            file,
            folder: folder.to_owned(),
            known: BTreeMap::new(),
            opacities: 0,
        }
    }

    /// Copies the picture of a texture; none if the texture has none.
    pub fn copy(&mut self, info: &TextureInfo) -> Result<Option<Picture>, Error> {
        let Some((image, is_nearest, is_clamped)) = self.source(info)? else {
            return Ok(None);
        };
        if !self.known.contains_key(&image) {
            let picture = self.copy_image(image)?;
            self.known.insert(image, picture);
        }
        Ok(Some(Picture {
            is_nearest,
            is_clamped,
            ..self.known[&image].clone()
        }))
    }

    /// Finds the image of a texture, and how it is sampled.
    fn source(&self, info: &TextureInfo) -> Result<Option<(usize, bool, bool)>, Error> {
        let path = &self.file.path;
        let texture = File::entry(&self.file.json.textures, "textures", info.index);
        let texture = texture.map_err(|reason| refusal(path, reason))?;
        let Some(image) = texture.source else {
            return match removable_extension(texture.extensions.keys()) {
                Some(name) => {
                    let reason = refuse_removable(name, path);
                    refuse!(path, "textures[{}] {reason}", info.index)
                }
                None => Ok(None),
            };
        };
        let sampler = texture
            .sampler
            .and_then(|sampler| self.file.json.samplers.get(sampler));
        let (nearest, repeat) = (9728, 10497);
        let is_nearest = sampler.is_some_and(|sampler| sampler.mag_filter == Some(nearest));
        let is_clamped = sampler.is_some_and(|sampler| {
            [sampler.wrap_s, sampler.wrap_t]
                .iter()
                .flatten()
                .any(|wrap| *wrap != repeat)
        });
        Ok(Some((image, is_nearest, is_clamped)))
    }

    fn copy_image(&self, image: usize) -> Result<Picture, Error> {
        let path = &self.file.path;
        let fail = |reason: String| refuse!(path, "images[{image}] {reason}");
        let bytes = self
            .file
            .image(image)
            .map_err(|reason| refusal(path, reason))?;
        let ending = match image::guess_format(&bytes) {
            Ok(ImageFormat::Png) => "png",
            Ok(ImageFormat::Jpeg) => "jpg",
            _ if bytes.starts_with(KTX2) => {
                return fail(refuse_removable("KHR_texture_basisu", path));
            }
            _ if bytes.get(8..12) == Some(b"WEBP") => {
                return fail(refuse_removable("EXT_texture_webp", path));
            }
            _ => return fail("is neither PNG nor JPEG; convert it".into()),
        };
        let decoded = match decode(&bytes) {
            Ok(decoded) => decoded,
            Err(reason) => return fail(format!("is broken: {reason}; export it again")),
        };
        let name = format!(
            "{FOLDER}/{image}_{}.{ending}",
            plain_name(&self.file.json.images[image].name)
        );
        write_atomically(&self.folder.join(&name), &bytes)?;
        let (mean, least_alpha) = measure(&decoded);
        Ok(Picture {
            name,
            mean,
            least_alpha,
            is_nearest: false,
            is_clamped: false,
        })
    }

    /// Writes the opacity of a picture whose alpha is `slope` times alpha plus `offset`, exact
    /// between texels too.
    pub fn write_opacity(
        &mut self,
        info: &TextureInfo,
        [slope, offset]: [f32; 2],
    ) -> Result<Option<String>, Error> {
        let Some((image, ..)) = self.source(info)? else {
            return Ok(None);
        };
        let bytes = self
            .file
            .image(image)
            .map_err(|reason| refusal(&self.file.path, reason))?;
        let decoded = decode(&bytes)
            .map_err(|reason| refusal(&self.file.path, format_args!("images[{image}] {reason}")))?;
        let alphas = decoded.into_rgba16();
        let mapped = image::ImageBuffer::from_fn(alphas.width(), alphas.height(), |x, y| {
            let alpha = f32::from(alphas.get_pixel(x, y).0[3]) / 65535.0;
            image::Luma([((slope * alpha + offset).clamp(0.0, 1.0) * 65535.0).round() as u16])
        });
        let mut bytes = Cursor::new(Vec::new());
        (DynamicImage::ImageLuma16(mapped).write_to(&mut bytes, ImageFormat::Png))
            .expect("a picture in memory can be encoded");
        let name = format!("{FOLDER}/opacity_{}.png", self.opacities);
        self.opacities += 1;
        write_atomically(&self.folder.join(&name), bytes.get_ref())?;
        Ok(Some(name))
    }
}

fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes));
    let mut limits = Limits::default();
    limits.max_alloc = Some(16 * MAX_TEXELS);
    reader.limits(limits);
    let reader = reader
        .with_guessed_format()
        .map_err(|error| error.to_string())?;
    reader.decode().map_err(|error| error.to_string())
}

/// Returns the mean of each component, and the smallest alpha.
fn measure(picture: &DynamicImage) -> ([f32; 4], f32) {
    let picture = picture.to_rgba8();
    let mut sums = [0.0f64; 4];
    let mut least = 255;
    for pixel in picture.pixels() {
        for (sum, value) in sums.iter_mut().zip(pixel.0) {
            *sum += f64::from(value);
        }
        least = least.min(pixel.0[3]);
    }
    let count = f64::from(picture.width()) * f64::from(picture.height()) * 255.0;
    (
        sums.map(|sum| (sum / count.max(1.0)) as f32),
        f32::from(least) / 255.0,
    )
}

/// Keeps letters that need no escape.
pub fn plain_name(name: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    let plain: String = name
        .chars()
        .map(|letter| if is_plain(letter) { letter } else { '_' })
        .collect();
    plain.chars().take(60).collect()
}
