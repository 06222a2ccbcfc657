//! Texture files of an export.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{FileError, display_srgb, write_atomically};
use serde_json::json;
use tracer::limits::LARGEST_IMAGE_FILE;
use tracer::{Location, Scene, Texture};

use crate::export::document::Document;

/// Folder of the textures, next to the document.
const FOLDER: &str = "textures";

/// Textures written so far.
pub struct Textures<'a> {
    scene: &'a Scene,
    /// Origin of the scene: on disk, or in the program.
    origin: &'a Location,
    folder: PathBuf,
    /// Textures of the document: the scene's files, and joins of a colour with an opacity.
    known: BTreeMap<[Option<usize>; 2], usize>,
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

    /// Adds the texture of a colour, an opacity or both; returns its index in the document, or none for neither.
    pub fn add(
        &mut self,
        document: &mut Document,
        color: Option<usize>,
        opacity: Option<usize>,
    ) -> Result<Option<usize>, FileError> {
        let key = [color, opacity];
        if let Some(known) = self.known.get(&key) {
            return Ok(Some(*known));
        }
        let (name, bytes) = match key {
            [None, None] => return Ok(None),
            [Some(color), None] => self.read_file(color)?,
            [color, Some(opacity)] => self.join(color, opacity),
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

    /// Makes the file of a texture from one file's colour and another's alpha, since glTF has one file for both. It has the size of the
    /// larger one; the smaller one is sampled at the nearest texel.
    fn join(&self, color: Option<usize>, opacity: usize) -> (String, Vec<u8>) {
        let color_texture = color.map(|index| &self.scene.textures[index]);
        let opacity_texture = &self.scene.textures[opacity];
        let sides = |texture: &Texture| [texture.width, texture.height];
        let [width, height] = match color_texture.map(sides) {
            None => sides(opacity_texture),
            Some(own) => [0, 1].map(|side| own[side].max(sides(opacity_texture)[side])),
        };
        let place = |x: u32, y: u32| {
            [(x, width), (y, height)].map(|(at, side)| (f64::from(at) + 0.5) / f64::from(side))
        };
        let linear = frame::Image::from_fn(width, height, |x, y| match color_texture {
            None => [1.0; 3],
            Some(texture) => {
                let [red, green, blue, _] = nearest(texture, place(x, y));
                [red, green, blue]
            }
        });
        let encoded = display_srgb(&linear, 0.0);
        let picture = image::RgbaImage::from_fn(width, height, |x, y| {
            let [red, green, blue] = encoded.at(x, y).map(to_byte);
            let alpha = to_byte(nearest(opacity_texture, place(x, y))[3]);
            image::Rgba([red, green, blue, alpha])
        });
        let name = match color {
            Some(color) => format!("{color}_with_opacity_{opacity}.png"),
            None => format!("opacity_{opacity}.png"),
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
