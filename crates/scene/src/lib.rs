//! Scenes of moving OBJ meshes: their files, their motion and their variants.
//!
//! It follows the conventions of the [`frame`] crate.

mod frame_rate;
pub mod limits;
mod load;
mod location;
mod model;
mod motion;
mod picture_size;
mod scene_id;
mod seal;
mod sequence;
#[cfg(test)]
mod test_scene;

/// Hash of the sources.
pub const SOURCE_HASH: &str = env!("SOURCE_HASH");

pub use frame_rate::FrameRate;
pub use load::{
    SceneError, SceneListing, list_scene, list_scenes, load_scene, load_scene_and_files,
};
pub use location::{Bundle, Location};
pub use model::{
    Background, Camera, Display, EnvironmentMap, Family, Finish, FlipExposures, Interpolation, Key,
    Lens, Material, Mesh, Motion, Object, Parent, Scene, Shape, Sun, Texture, Translucency, Turn,
};
pub use motion::curve::{Cubic, CurveMaxima, Quantity};
pub use motion::keys::{Rotation, Segment, key_times, times_within};
pub use motion::shape::ShapeAt;
pub use picture_size::{SizeError, check_size};
pub use scene_id::SceneId;
pub use seal::Seal;
pub use seal::chance::Chance;
pub use sequence::UndefinedTime;
