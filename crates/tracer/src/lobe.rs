//! The directions in which a diffuse surface scatters.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// A cosine lobe about the shading normal, its part below the facet folded up.
///
/// Interpolated normals turn part of the lobe into the body. Dropping that part would darken every smooth mesh;
/// mirrored at the facet it keeps the albedo exact, and sampling and evaluation stay each other's equal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobe {
    facet: DVec3,
    normal: DVec3,
}

impl Lobe {
    /// Both unit and within 90 degrees of one another.
    pub fn new(facet: DVec3, normal: DVec3) -> Self {
        Self { facet, normal }
    }

    /// Probability per steradian of a unit direction: the scattered share of light is albedo times this.
    pub fn density(&self, direction: DVec3) -> f64 {
        let above = direction.dot(self.facet);
        if above <= 0.0 {
            return 0.0;
        }
        let mirrored = direction - 2.0 * above * self.facet;
        (self.normal.dot(direction).max(0.0) + self.normal.dot(mirrored).max(0.0)) / PI
    }

    /// A direction of that density from two numbers in [0, 1).
    pub fn sample(&self, u: f64, v: f64) -> DVec3 {
        let radius = u.sqrt();
        let (sine, cosine) = (TAU * v).sin_cos();
        let (tangent, bitangent) = self.normal.any_orthonormal_pair();
        let direction =
            radius * cosine * tangent + radius * sine * bitangent + (1.0 - u).sqrt() * self.normal;
        let above = direction.dot(self.facet);
        direction + 2.0 * (-above).max(0.0) * self.facet
    }
}
