//! Scenes for other programs: glTF 2.0, one folder per scene.
//!
//! An engine that plays the animation draws the scene that the tracer renders, so that the errors
//! of its frames and its blur can be measured. [`export_gltf`] writes `scene.gltf` with `scene.bin`
//! and textures, the sky as `sky.exr`, and `manifest.json`, which adds what glTF cannot express:
//! times of the shutter, object ids, and the meaning of the numbers.

mod animation;
mod document;
mod light;
mod manifest;
mod material;
mod mesh;
mod motion;
mod scene;
mod textures;
mod timeline;

pub use manifest::Manifest;
pub use scene::export_gltf;
pub use timeline::{FRAMES_PER_SECOND, Timeline};
