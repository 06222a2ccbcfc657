//! The radiance along paths of light.

pub(crate) mod integrator;
pub(crate) mod stops;
