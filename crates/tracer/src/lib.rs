//! A CPU path tracer: from a scene of moving OBJ meshes to the frame of one instant and the truth of a shutter interval.
//!
//! The conventions are those of the [`frame`] crate.

mod load;
mod motion;
mod scene;

pub use load::{SceneError, SceneListing, list_scenes, load_scene};
pub use motion::{Key, Motion, Turn};
pub use scene::{
    Background, Camera, Display, Family, FlipExposures, Material, Mesh, Object, Parent, Scene, Sun,
    Texture,
};
