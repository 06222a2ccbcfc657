//! Verification of rendered files: random tiles are traced again, and must be equal byte for byte.

pub mod difference;
pub mod scene;
pub mod scene_renders;
pub mod tiles;
