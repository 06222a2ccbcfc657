//! A scene in memory: the checked content of `scenes/<name>/scene.toml` and its meshes.

use std::path::PathBuf;

use frame::ShutterProfile;
pub use frame::{Display, FlipExposures};
use glam::{DAffine3, DVec3, Vec2, Vec3};

use crate::frame_rate::FrameRate;
use crate::motion::keys::Motion;

/// The input of a render. Indices are valid, numbers finite, meshes not empty.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Folder name, with the variant and the frame rate if they were chosen, and the frame if it is a later one:
    /// `sliding_panel@64px_45deg`, `fan@24fps`, `fan/0003`.
    pub name: String,
    /// Frames of the scene's own clock at its instant; above 0 for what [`Scene::at_frame`] made.
    pub frame: u32,
    /// Defect that the scene exposes, in one sentence.
    pub exposes: String,
    /// Family, for leave-one-family-out cross-validation.
    pub family: Family,
    /// Exposure in frames; 0.5 = 180 degrees.
    pub exposure: f64,
    /// Frame rate that times and exposure are for.
    pub rate: FrameRate,
    /// Exposure of the scene's file, in frames of the file.
    pub written_exposure: f64,
    /// Opening and closing of the shutter, and the delay from row to row.
    pub shutter_profile: ShutterProfile,
    /// Default width in pixels.
    pub width: u32,
    /// Default height in pixels.
    pub height: u32,
    /// Display of pictures, for people and for comparison.
    pub display: Display,
    /// Camera.
    pub camera: Camera,
    /// Radiance of rays that leave the scene.
    pub background: Background,
    /// Distant light.
    pub sun: Option<Sun>,
    /// Meshes in object space; several objects may share one.
    pub meshes: Vec<Mesh>,
    /// Textures, decoded to linear.
    pub textures: Vec<Texture>,
    /// Surfaces.
    pub materials: Vec<Material>,
    /// Objects by id; the first has id 1 (0 is the background).
    pub objects: Vec<Object>,
    /// Notes for the user on parts of the files that are left out, a line each.
    pub notes: Vec<String>,
    /// Hash of every file and choice that the scene was made from, in hexadecimal.
    pub hash: String,
}

/// The kind of motion that a scene is about.
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

/// A camera that looks along its own -Z, +Y up.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Transform from camera to world; never scales.
    pub motion: Motion,
    /// At least one key of time in frames and vertical field of view in radians. Between and beyond its keys the field of
    /// view is interpolated as the motion is.
    pub vertical_fov: Vec<(f64, f64)>,
    /// Lens; none for a pinhole.
    pub lens: Option<Lens>,
}

/// A thin lens: a disc across the view axis, around the camera's position. It has no errors and does not darken the picture: a pixel
/// is the mean of what the pinholes at all points of the disc see.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Lens {
    /// Diameter in metres, above 0.
    pub aperture: f64,
    /// Distance along the view axis at which points are sharp, in metres, above 0.
    pub focus: f64,
}

/// Radiance from infinity.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// Radiance that is the same from everywhere.
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
    /// Turn of the map about +Y, in radians.
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
    /// Unit normals, one per position; empty where the file has none (then facets are flat).
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position, v up; empty where the file has none.
    pub texcoords: Vec<Vec2>,
    /// Indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// Index into the object's `materials`, per triangle.
    pub slots: Vec<u32>,
    /// Key shapes at strictly rising times: none for a rigid mesh, else at least two, of which the first is `positions` and
    /// `normals`. Vertices move in straight lines between them, and beyond the ends as between the nearest two.
    pub shapes: Vec<Shape>,
}

/// A mesh's vertices at one time.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Frames relative to the instant.
    pub time: f64,
    /// Metres, as many as the mesh has.
    pub positions: Vec<Vec3>,
    /// Unit normals, or zero where the face is flat; as many as the mesh has.
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
    /// Linear albedo (Kd), each component in [0, 1]; multiplied by the texture if there is one. A conductor's
    /// reflectance at normal incidence.
    pub diffuse: Vec3,
    /// Index into the scene's textures (map_Kd).
    pub diffuse_texture: Option<usize>,
    /// Emitted radiance (Ke), from both sides.
    pub emission: Vec3,
    /// Index into the scene's textures (map_Ke); multiplies `emission`. Without albedo it makes an unlit surface.
    pub emission_texture: Option<usize>,
    /// Opacity (d). Where it is below 0.5, times its texture's, the surface has a hole, unless it is translucent.
    pub opacity: f32,
    /// Index into the scene's textures (map_d); its alpha counts if it has one, else its first component undecoded.
    pub opacity_texture: Option<usize>,
    /// What happens to the light that opacity leaves, if opacity mixes the surface with what lies behind it; none where
    /// opacity cuts holes.
    pub translucency: Option<Translucency>,
}

/// The light that a translucent surface does not stop. It passes straight through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Translucency {
    /// Part of the light that passes (Tf), each component in [0, 1]; in glass, of each passage from side to side.
    pub filter: Vec3,
    /// Index of refraction of a pane of glass, which reflects a part of the light on its two sides; none for a film that
    /// reflects nothing.
    pub glass: Option<f32>,
    /// True if velocity, depth and object id are those of this surface; else they are those of what lies behind it, as
    /// engines have it.
    pub in_buffers: bool,
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
    /// Makes a surface that sends out its albedo and reflects nothing; one that emits keeps its radiance.
    fn unlit(self) -> Self {
        let (emission, emission_texture) = match self.emission == Vec3::ZERO {
            true => (self.diffuse, self.diffuse_texture),
            false => (self.emission, self.emission_texture),
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

/// The reflection of a surface. Roughness is 0 for a mirror, else from [`Finish::SMOOTHEST`] to 1; its square is the width of
/// the GGX distribution of slopes.
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

/// The space that an object's motion is relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parent {
    /// The world.
    World,
    /// The camera, as for a dashboard.
    Camera,
    /// An earlier object, by index.
    Object(usize),
}

/// A mesh in motion.
#[derive(Clone, Debug)]
pub struct Object {
    /// Unique name of letters, digits, `_` and `-`; also that of its coverage channel.
    pub name: String,
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// Index into the scene's materials, per slot of the mesh.
    pub materials: Vec<usize>,
    /// Motion relative to the parent.
    pub motion: Motion,
    /// Parent.
    pub parent: Parent,
}

impl Scene {
    /// Makes every surface send out its albedo, whatever the light: what emits keeps its radiance, and glass reflects nothing.
    /// There is no sun, and the background lights nothing. An engine that knows no light at all draws the same radiance.
    pub fn unlit(self) -> Self {
        let materials = self.materials.into_iter().map(Material::unlit);
        Self {
            materials: materials.collect(),
            sun: None,
            ..self
        }
    }

    /// Tells whether every surface sends out its own colour alone, whatever light falls on it.
    pub fn is_unlit(&self) -> bool {
        self.materials.iter().all(|own| {
            let is_glass = own.translucency.is_some_and(|own| own.glass.is_some());
            own.finish == Finish::Diffuse && own.diffuse == Vec3::ZERO && !is_glass
        })
    }

    /// Takes the camera's lens away: everything is sharp.
    pub fn pinhole(self) -> Self {
        let camera = Camera {
            lens: None,
            ..self.camera
        };
        Self { camera, ..self }
    }

    /// Names of the background and the objects, by id.
    pub fn object_names(&self) -> Vec<String> {
        let objects = self.objects.iter().map(|object| object.name.clone());
        std::iter::once("background".to_owned())
            .chain(objects)
            .collect()
    }

    /// Motions from the object outwards to the world.
    pub(crate) fn motion_chain(&self, object: usize) -> Vec<&Motion> {
        let mut motions = vec![&self.objects[object].motion];
        let mut parent = self.objects[object].parent;
        loop {
            match parent {
                Parent::World => return motions,
                Parent::Camera => {
                    motions.push(&self.camera.motion);
                    return motions;
                }
                Parent::Object(index) => {
                    motions.push(&self.objects[index].motion);
                    parent = self.objects[index].parent;
                }
            }
        }
    }

    /// Transform from the object's space to the world at `time` (frames).
    pub fn object_to_world(&self, object: usize, time: f64) -> DAffine3 {
        let outwards = self.motion_chain(object).into_iter();
        let transforms = outwards.rev().map(|motion| motion.at(time));
        transforms
            .reduce(|outer, own| outer * own)
            .expect("an object is in its own chain")
    }
}
