//! The values of a BRDF: its evaluation in a direction, and a sampled direction.

use glam::{DVec3, Vec3};

/// The value of a BRDF in one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BrdfValue {
    /// Radiance sent to the viewer per radiance arriving per steradian, cosine included.
    pub scattered: Vec3,
    /// Probability per steradian with which sampling draws the direction.
    pub density: f64,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BrdfSample {
    /// Unit vector, on the facet's side.
    pub direction: DVec3,
    /// Scattered radiance over the density.
    pub weight: Vec3,
    /// Probability per steradian; none for the single direction of a mirror, which nothing else can
    /// draw.
    pub density: Option<f64>,
}

impl BrdfValue {
    /// No light, and no chance of drawing the direction.
    pub const ZERO: BrdfValue = BrdfValue {
        scattered: Vec3::ZERO,
        density: 0.0,
    };
}
