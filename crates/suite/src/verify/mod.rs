//! Verification of kept frames, truths and ladders: random tiles are traced again, and must be equal byte for byte.

pub mod chance;
pub mod difference;
pub mod kept_scene;
pub mod listing;
pub mod tiles;
pub mod work;
