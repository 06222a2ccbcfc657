//! Lights, and the radiance along paths.

pub(crate) mod environment;
pub(crate) mod lights;
pub(crate) mod path;
pub(crate) mod sky;
