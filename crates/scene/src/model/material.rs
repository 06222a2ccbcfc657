//! Surfaces and their textures.

use std::path::PathBuf;

use glam::Vec3;

/// Linear RGBA texels, row-major from the top left; sampled bilinearly, repeating.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The image file.
    pub path: PathBuf,
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Colour decoded from sRGB; alpha unchanged.
    pub texels: Vec<[f32; 4]>,
}

/// A two-sided surface that may emit, with cut-outs or translucent.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the MTL file.
    pub name: String,
    /// Reflection.
    pub finish: Finish,
    /// Linear albedo (Kd), each component in [0, 1]; multiplied by the texture if there is one. A
    /// conductor's reflectance at normal incidence.
    pub diffuse: Vec3,
    /// Index into the scene's textures (map_Kd).
    pub diffuse_texture: Option<usize>,
    /// Emitted radiance (Ke), from both sides.
    pub emission: Vec3,
    /// Index into the scene's textures (map_Ke); multiplies `emission`. Without albedo it makes an
    /// unlit surface.
    pub emission_texture: Option<usize>,
    /// Opacity (d). Where opacity times its texture's is below 0.5, the surface has a hole, unless
    /// it is translucent.
    pub opacity: f32,
    /// Index into the scene's textures (map_d); its alpha counts if it has one, else its first
    /// component undecoded.
    pub opacity_texture: Option<usize>,
    /// Treatment of the light that opacity leaves, if opacity mixes the surface with what
    /// is behind it; none if opacity cuts holes.
    pub translucency: Option<Translucency>,
}

/// The light that a translucent surface does not stop. It passes straight through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translucency {
    /// Part of the light that passes (Tf), each component in [0, 1]; in glass, of each passage from
    /// side to side.
    pub filter: Vec3,
    /// Index of refraction of a pane of glass, which reflects a part of the light on its two sides;
    /// none for a film that reflects nothing.
    pub glass: Option<f32>,
    /// True if velocity, depth and object id come from this surface; else from what is behind it,
    /// as in engines.
    pub in_buffers: bool,
}

impl Default for Material {
    /// A black surface without a name.
    fn default() -> Self {
        Self {
            name: String::new(),
            finish: Finish::Diffuse,
            diffuse: Vec3::ZERO,
            diffuse_texture: None,
            emission: Vec3::ZERO,
            emission_texture: None,
            opacity: 1.0,
            opacity_texture: None,
            translucency: None,
        }
    }
}

impl Translucency {
    /// All light passes.
    pub const CLEAR: Self = Self {
        filter: Vec3::ONE,
        glass: None,
        in_buffers: false,
    };
}

impl Material {
    /// Opacity below which a surface has a hole, unless it is translucent.
    pub const HOLE: f32 = 0.5;

    /// Makes a surface that sends out its albedo and reflects nothing; one that emits keeps its
    /// radiance.
    pub(super) fn unlit(self) -> Self {
        let (emission, emission_texture) = if self.emission == Vec3::ZERO {
            (self.diffuse, self.diffuse_texture)
        } else {
            (self.emission, self.emission_texture)
        };
        Self {
            finish: Finish::Diffuse,
            diffuse: Vec3::ZERO,
            diffuse_texture: None,
            emission,
            emission_texture,
            translucency: self.translucency.map(|passing| Translucency {
                glass: None,
                ..passing
            }),
            ..self
        }
    }
}

/// The reflection of a surface. Roughness is 0 for a mirror, else from [`Finish::SMOOTHEST`] to 1;
/// its square is the width of the GGX distribution of slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// Diffuse reflection (Lambert).
    Diffuse,
    /// Bare metal.
    Conductor {
        /// Roughness (Pr).
        roughness: f32,
    },
    /// Diffuse below a dielectric coat.
    Coated {
        /// Roughness (Pr).
        roughness: f32,
        /// Index of refraction of the coat, above 1 (Ni).
        index: f32,
    },
}

impl Finish {
    /// Smallest roughness that is not a mirror.
    pub const SMOOTHEST: f32 = 0.01;
    /// Largest index of refraction, more than diamond's.
    pub const DENSEST: f32 = 4.0;
}
