//! A scene in memory: the checked content of `scenes/<name>/scene.toml` and its meshes.

mod environment;
mod light;
mod material;
mod mesh;
mod motion;
mod texture;

use frame::ShutterProfile;
pub use frame::{Display, FlipExposures};
use glam::Vec3;

use crate::frame_rate::FrameRate;
use crate::scene_id::SceneId;
pub use light::{Background, EnvironmentMap, Sun};
pub use material::{Finish, Material, Texture, Translucency};
pub use mesh::{Mesh, Shape};
pub use motion::{Interpolation, Key, Motion, Turn};

/// The input of a render. Indices are valid, numbers finite, meshes not empty.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Identity; its frame is above 0 if [`Scene::at_frame`] made the scene.
    pub id: SceneId,
    /// Defect that the scene exposes, in one sentence.
    pub exposes: String,
    /// Family, for leave-one-family-out cross-validation.
    pub family: Family,
    /// Exposure in frames; 0.5 = 180 degrees.
    pub exposure: f64,
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
    /// At least one key of time in frames and vertical field of view in radians. Between and beyond
    /// its keys the field of view is interpolated as the motion is.
    pub vertical_fov: Vec<(f64, f64)>,
    /// Lens; none for a pinhole.
    pub lens: Option<Lens>,
}

/// A thin lens: a disc across the view axis, around the camera's position. It has no errors and
/// does not darken the picture: a pixel is the mean of what the pinholes at all points of the disc
/// see.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Lens {
    /// Diameter in metres, above 0.
    pub aperture: f64,
    /// Distance along the view axis at which points are sharp, in metres, above 0.
    pub focus: f64,
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
    /// Unique name of letters, digits, `_` and `-`; also its coverage channel's.
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
    /// Makes every surface send out its albedo in any light: emitters keep their radiance, and
    /// glass reflects nothing. There is no sun, and the background lights nothing. An engine
    /// without lights draws the same radiance.
    pub fn unlit(self) -> Self {
        let materials = self.materials.into_iter().map(Material::unlit);
        Self {
            materials: materials.collect(),
            sun: None,
            ..self
        }
    }

    /// Returns whether every surface sends out its own colour alone, in any light.
    pub fn is_unlit(&self) -> bool {
        self.materials.iter().all(|material| {
            let is_glass = material
                .translucency
                .is_some_and(|translucency| translucency.glass.is_some());
            material.finish == Finish::Diffuse && material.diffuse == Vec3::ZERO && !is_glass
        })
    }

    /// Returns the frame rate that times and exposure are for.
    pub fn rate(&self) -> FrameRate {
        self.id.rate.unwrap_or_default()
    }

    /// Removes the camera's lens: everything is sharp.
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

    /// Changes every time: of keys, of the field of view and of key shapes.
    pub(crate) fn change_times(&mut self, change: impl Fn(f64) -> f64) {
        let objects = self.objects.iter_mut().map(|object| &mut object.motion);
        let motions = objects.chain([&mut self.camera.motion]);
        let keys = motions.flat_map(|motion| &mut motion.keys);
        let shapes = self.meshes.iter_mut().flat_map(|mesh| &mut mesh.shapes);
        let views = self.camera.vertical_fov.iter_mut();
        (keys.map(|key| &mut key.time))
            .chain(shapes.map(|shape| &mut shape.time))
            .chain(views.map(|(time, _)| time))
            .for_each(|time| *time = change(*time));
    }
}
