//! Texture files of an export.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{FileError, display_srgb, write_atomically};
use glam::Vec3;
use scene::{Location, Scene, Texture, limits::LARGEST_IMAGE_FILE};
use serde_json::json;

use crate::export::document::Document;

/// Folder of the textures, next to the document.
const FOLDER: &str = "textures";

/// Textures written so far.
pub struct Textures<'a> {
    scene: &'a Scene,
    /// Origin of the scene: on disk, or in the program.
    origin: &'a Location,
    folder: PathBuf,
    /// Textures of the document: the scene's files, and joins of a colour, an opacity and a tint.
    known: BTreeMap<([Option<usize>; 2], [u32; 3]), usize>,
}

impl<'a> Textures<'a> {
    /// Makes an empty folder of textures below the document's.
    pub fn new(scene: &'a Scene, origin: &'a Location, folder: &Path) -> Self {
        Self {
            scene,
            origin,
            folder: folder.to_owned(),
            known: BTreeMap::new(),
        }
    }

    /// Adds the texture of a colour, multiplied by a tint, of an opacity or of both; returns its
    /// index in the document, or none for neither.
    pub fn add(
        &mut self,
        document: &mut Document,
        textures: [Option<usize>; 2],
        tint: Vec3,
    ) -> Result<Option<usize>, FileError> {
        let key = (textures, tint.to_array().map(f32::to_bits));
        if let Some(known) = self.known.get(&key) {
            return Ok(Some(*known));
        }
        let (name, bytes) = match textures {
            [None, None] => return Ok(None),
            [Some(color), None] if tint == Vec3::ONE => self.read_file(color)?,
            _ => self.join(textures, tint),
        };
        write_atomically(&self.folder.join(FOLDER).join(&name), &bytes)?;
        let texture = push_texture(document, &name);
        self.known.insert(key, texture);
        Ok(Some(texture))
    }

    /// Reads a texture's file unchanged, and names its copy.
    fn read_file(&self, texture: usize) -> Result<(String, Vec<u8>), FileError> {
        let path = &self.scene.textures[texture].path;
        let bytes = self.origin.at(path).read(LARGEST_IMAGE_FILE)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Ok((format!("{texture}_{}", plain_name(&name)), bytes))
    }

    /// Makes the file of a texture from one file's colour and another's alpha, since glTF has one
    /// file for both, and from a tint. It has the size of the larger one; the smaller one is
    /// sampled at the nearest texel.
    fn join(&self, textures: [Option<usize>; 2], tint: Vec3) -> (String, Vec<u8>) {
        let [color, opacity] =
            textures.map(|texture| texture.map(|index| &self.scene.textures[index]));
        let both = || [color, opacity].into_iter().flatten();
        let width = both().map(|texture| texture.width).max().unwrap_or(1);
        let height = both().map(|texture| texture.height).max().unwrap_or(1);
        let place = |x: u32, y: u32| {
            [(x, width), (y, height)].map(|(at, side)| (f64::from(at) + 0.5) / f64::from(side))
        };
        let linear = frame::Image::from_fn(width, height, |x, y| {
            let texel = color.map_or([1.0; 4], |texture| nearest(texture, place(x, y)));
            (Vec3::from_slice(&texel) * tint).to_array()
        });
        let encoded = display_srgb(&linear, 0.0);
        let picture = image::RgbaImage::from_fn(width, height, |x, y| {
            let [red, green, blue] = encoded.at(x, y).map(to_byte);
            let alpha = opacity.map_or(1.0, |texture| nearest(texture, place(x, y))[3]);
            image::Rgba([red, green, blue, to_byte(alpha)])
        });
        let name = match textures {
            [Some(color), Some(opacity)] => format!("{color}_with_opacity_{opacity}.png"),
            [Some(color), None] => format!("{color}_tinted_{}.png", self.known.len()),
            [None, opacity] => format!("opacity_{}.png", opacity.unwrap_or_default()),
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        (picture.write_to(&mut bytes, image::ImageFormat::Png))
            .expect("a picture in memory can be encoded");
        (name, bytes.into_inner())
    }
}

fn push_texture(document: &mut Document, name: &str) -> usize {
    if document.list("samplers").is_empty() {
        // Linear, and linear between mipmaps; textures repeat by default.
        let sampler = json!({ "magFilter": 9729, "minFilter": 9987 });
        document.push("samplers", sampler);
    }
    let image = json!({ "name": name, "uri": format!("{FOLDER}/{name}") });
    let image = document.push("images", image);
    let texture = json!({ "name": name, "sampler": 0, "source": image });
    document.push("textures", texture)
}

/// Replaces characters that need an escape in a URI.
fn plain_name(name: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "._-".contains(letter);
    name.replace(|letter| !is_plain(letter), "_")
}

fn nearest(texture: &Texture, place: [f64; 2]) -> [f32; 4] {
    let at = |place: f64, side: u32| ((place * f64::from(side)) as u32).min(side - 1);
    let (x, y) = (at(place[0], texture.width), at(place[1], texture.height));
    texture.texels[(y * texture.width + x) as usize]
}

fn to_byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}
