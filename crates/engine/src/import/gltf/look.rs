//! What primitives look like: the name of a material, and the coordinates of its textures.

use glam::Vec2;

use super::geometry::Primitive;
use super::material_schema::{TextureInfo, TextureTransform};

/// What a primitive looks like.
#[derive(Clone, Debug)]
pub struct Look {
    /// Name of the material in the MTL file.
    pub name: String,
    /// True if light passes through it.
    pub is_blended: bool,
    /// Texture coordinates that its textures are read at; none without textures.
    pub mapping: Option<Mapping>,
    /// True if a texture does not repeat.
    pub is_clamped: bool,
}

/// Texture coordinates of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapping {
    /// Number of the set of texture coordinates.
    pub set: usize,
    pub transform: TextureTransform,
}

impl Mapping {
    /// Returns where a texture is read.
    pub fn of(info: &TextureInfo) -> Self {
        let transform = info.extensions.transform.clone().unwrap_or_default();
        Self {
            set: transform.tex_coord.unwrap_or(info.tex_coord),
            transform: TextureTransform {
                tex_coord: None,
                ..transform
            },
        }
    }
}

impl Look {
    /// Returns the texture coordinates of a primitive, v down: none without textures, and (0, 0)
    /// if the primitive lacks them.
    pub fn texcoords(&self, primitive: &Primitive) -> Vec<[f32; 2]> {
        let Some(Mapping { set, transform }) = &self.mapping else {
            return Vec::new();
        };
        let Some(texcoords) = primitive.texcoords.get(set) else {
            return vec![[0.0; 2]; primitive.positions.len()];
        };
        let (sine, cosine) = transform.rotation.sin_cos();
        let map = |texcoord: &Vec2| {
            let scaled = *texcoord * Vec2::from(transform.scale);
            // glTF turns by the matrix (cos, sin; -sin, cos).
            let turned = Vec2::new(
                cosine * scaled.x + sine * scaled.y,
                cosine * scaled.y - sine * scaled.x,
            );
            (turned + Vec2::from(transform.offset)).to_array()
        };
        texcoords.iter().map(map).collect()
    }
}
