//! A point drawn on a light, and the weights of samples that several methods might draw.

use glam::{DVec3, Vec3};

/// A point drawn on a light, as seen from a surface.
pub(crate) struct LightSample {
    /// Unit vector to the point.
    pub direction: DVec3,
    /// Metres; infinite for the sun and the background.
    pub distance: f64,
    /// Radiance that arrives if nothing is in between.
    pub radiance: Vec3,
    /// Probability per steradian of having drawn this direction.
    pub density: f64,
}

/// Probability per steradian of a point drawn uniformly on an area, seen at a distance and a cosine.
pub(crate) fn density_per_steradian(area: f64, distance: f64, cosine: f64) -> f64 {
    distance * distance / (area * cosine.abs())
}

/// Weight of a sample drawn with density `own` that `other` might have drawn as well: the power heuristic
/// (Veach 1997, section 9.2).
pub(crate) fn power_heuristic(own: f64, other: f64) -> f64 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}
