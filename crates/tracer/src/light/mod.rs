//! Lights, and the radiance along paths.

pub(crate) mod environment;
pub(crate) mod integrator;
pub(crate) mod light_sample;
pub(crate) mod lights;
pub(crate) mod sky;
pub(crate) mod stops;
