//! Lights: the sky, the sun and emissive triangles.

pub(crate) mod environment;
pub(crate) mod lights;
pub(crate) mod sky;
