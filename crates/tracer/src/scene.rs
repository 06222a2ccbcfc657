//! A scene in memory: what `scenes/<name>/scene.toml` and its meshes say, checked.

use std::path::PathBuf;

use frame::ShutterProfile;
pub use frame::{Display, FlipExposures};
use glam::{DAffine3, DVec3, Vec2, Vec3};

use crate::motion::keys::Motion;

/// Everything a render needs. Indices are valid, numbers finite, meshes not empty.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Folder name, with the variant if one was chosen: `sliding_panel@64px_45deg`.
    pub name: String,
    /// What the scene exposes, in one sentence.
    pub exposes: String,
    /// For leave-one-family-out cross-validation.
    pub family: Family,
    /// Exposure in frames; 0.5 = 180 degrees.
    pub exposure: f64,
    /// How the shutter opens and closes, and how rows follow one another.
    pub shutter_profile: ShutterProfile,
    /// Default width in pixels.
    pub width: u32,
    /// Default height in pixels.
    pub height: u32,
    /// How it is shown and compared.
    pub display: Display,
    /// The eye.
    pub camera: Camera,
    /// What rays see that leave the scene.
    pub background: Background,
    /// A distant light.
    pub sun: Option<Sun>,
    /// Geometry in object space; several objects may share one.
    pub meshes: Vec<Mesh>,
    /// Textures, decoded to linear.
    pub textures: Vec<Texture>,
    /// Surfaces.
    pub materials: Vec<Material>,
    /// In order of their ids, the first having id 1 (0 is the background).
    pub objects: Vec<Object>,
    /// What its files hold that is left out, a line each: for the user to know.
    pub notes: Vec<String>,
    /// Hash of every file and choice that the scene was made from, in hexadecimal.
    pub hash: String,
}

/// What kind of motion a scene is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// Objects in straight motion.
    Translation,
    /// Spinning and rolling.
    Rotation,
    /// The camera moves.
    Camera,
    /// Parts thinner than the motion.
    Thin,
    /// Movers in front of and behind other things.
    Overlap,
    /// Meshes that change shape.
    Deforming,
    /// Borders, thresholds, extremes.
    Limits,
}

impl Family {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Family::Translation => "translation",
            Family::Rotation => "rotation",
            Family::Camera => "camera",
            Family::Thin => "thin",
            Family::Overlap => "overlap",
            Family::Deforming => "deforming",
            Family::Limits => "limits",
        }
    }
}

/// A pinhole camera that looks along its own -Z, +Y up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// From camera to world; never scales.
    pub motion: Motion,
    /// (time in frames, vertical field of view in radians), at least one; between these keys and beyond them it changes
    /// as the motion does.
    pub vertical_fov: Vec<(f64, f64)>,
}

/// Radiance from infinity.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// The same from everywhere.
    Constant(Vec3),
    /// Piecewise linear in the height (y) of the unit direction: `ground` at -1, `horizon` at 0, `zenith` at +1.
    Gradient {
        /// Radiance straight down.
        ground: Vec3,
        /// Radiance at eye level.
        horizon: Vec3,
        /// Radiance straight up.
        zenith: Vec3,
    },
    /// An image of all directions.
    Map(EnvironmentMap),
}

/// Radiance by direction, in longitude (from left to right) and latitude (from +Y at the top to -Y).
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    /// The image file.
    pub path: PathBuf,
    /// Texels around the horizon, twice as many as rows. The middle of the image lies towards -Z, its right quarter towards
    /// +X.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear radiance, row-major from the top left; not negative, finite.
    pub texels: Vec<[f32; 3]>,
    /// Factor on the texels.
    pub strength: f32,
    /// Radians by which the map is turned about +Y.
    pub rotation: f64,
}

/// A distant disc of constant radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector from the scene to the sun.
    pub direction: DVec3,
    /// Irradiance on a surface that faces it.
    pub irradiance: Vec3,
    /// Radius of its disc in radians; 0 is a point at infinity, which no camera ray and no bounce can hit.
    pub angular_radius: f64,
}

/// Triangles in object space.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// The OBJ file.
    pub path: PathBuf,
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Unit, one per position; empty where the file has none (then facets are flat).
    pub normals: Vec<Vec3>,
    /// One per position, v up; empty where the file has none.
    pub texcoords: Vec<Vec2>,
    /// Indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle: index into the object's `materials`.
    pub slots: Vec<u32>,
    /// Key shapes at strictly rising times; none for a rigid mesh, else at least two, the first being `positions` and
    /// `normals`. Vertices move in straight lines between them, and beyond them on as between the nearest two.
    pub shapes: Vec<Shape>,
}

/// A mesh's vertices at one time.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Frames relative to the instant.
    pub time: f64,
    /// Metres, as many as the mesh has.
    pub positions: Vec<Vec3>,
    /// Unit, or zero where the face is flat; as many as the mesh has.
    pub normals: Vec<Vec3>,
}

/// Linear RGBA texels, row-major from the top left; sampled bilinearly, repeating.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The image file.
    pub path: PathBuf,
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Colour decoded from sRGB, alpha as it is.
    pub texels: Vec<[f32; 4]>,
}

/// A two-sided surface that may emit, with cut-outs.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the MTL file.
    pub name: String,
    /// How it reflects.
    pub finish: Finish,
    /// Linear albedo (Kd), each component in [0, 1]; multiplied by the texture if there is one. A conductor's
    /// reflectance at normal incidence.
    pub diffuse: Vec3,
    /// map_Kd: index into the scene's textures.
    pub diffuse_texture: Option<usize>,
    /// Emitted radiance (Ke), from both sides.
    pub emission: Vec3,
    /// map_Ke: index into the scene's textures; multiplies `emission`. With no albedo it makes an unlit surface.
    pub emission_texture: Option<usize>,
    /// d: where opacity (times its texture's) is below 0.5 the surface has a hole.
    pub opacity: f32,
    /// map_d: index into the scene's textures; its alpha if it has one, else its first component undecoded.
    pub opacity_texture: Option<usize>,
}

/// How a surface reflects. Roughness is 0 for a mirror, else from [`Finish::SMOOTHEST`] to 1; its square is the width of the GGX
/// distribution of slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// The same towards everywhere (Lambert).
    Diffuse,
    /// Bare metal.
    Conductor {
        /// Pr.
        roughness: f32,
    },
    /// Diffuse below a dielectric coat.
    Coated {
        /// Pr.
        roughness: f32,
        /// Ni: index of refraction of the coat, above 1.
        index: f32,
    },
}

impl Finish {
    /// Smallest roughness that is not a mirror.
    pub const SMOOTHEST: f32 = 0.01;
    /// Largest index of refraction: more than diamond's.
    pub const DENSEST: f32 = 4.0;
}

/// What an object's motion is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parent {
    /// The world.
    World,
    /// The camera: a dashboard.
    Camera,
    /// An earlier object, by index.
    Object(usize),
}

/// A mesh in motion.
#[derive(Clone, Debug)]
pub struct Object {
    /// Letters, digits, `_` and `-`; unique; the name of its coverage channel.
    pub name: String,
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// Index into the scene's materials for each slot of the mesh.
    pub materials: Vec<usize>,
    /// Relative to the parent.
    pub motion: Motion,
    /// What it is attached to.
    pub parent: Parent,
}

impl Scene {
    /// From the object's space to the world at `time` (frames).
    pub fn object_to_world(&self, object: usize, time: f64) -> DAffine3 {
        // Chains of parents may be longer than a thread's stack: outwards first, and back.
        let mut chain = vec![object];
        let mut outermost = &self.objects[object];
        while let Parent::Object(parent) = outermost.parent {
            chain.push(parent);
            outermost = &self.objects[parent];
        }
        let own = |object: &usize| self.objects[*object].motion.at(time);
        let mut chain = chain.iter().rev().map(own);
        let first = chain.next().expect("an object is in its own chain");
        let first = match outermost.parent {
            Parent::Camera => self.camera.motion.at(time) * first,
            _ => first,
        };
        chain.fold(first, |outer, own| outer * own)
    }
}
