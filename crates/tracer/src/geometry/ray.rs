//! A half-line in `f64`, in the world or in an object's space, and its hit.

use glam::{DAffine3, DVec3};

/// Offset of secondary rays from their surface, as a part of the greatest coordinate. Positions are
/// exact to about 1e-14 of it.
pub(crate) const LIFT: f64 = 1e-9;

/// Relative difference of distances below which two surfaces are in one place: rounding of their
/// positions to 32 bits.
pub(crate) const IN_ONE_PLACE: f64 = 1e-6;

/// The points `origin + t * direction` for `t > 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Metres.
    pub origin: DVec3,
    /// Unit in the world. In an object's space it keeps the length that the transform gives it, so
    /// that `t` means the same in both.
    pub direction: DVec3,
}

impl Ray {
    /// The point at `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// The same ray in another space; `t` is unchanged.
    pub fn transformed(&self, to: &DAffine3) -> Ray {
        Ray {
            origin: to.transform_point3(self.origin),
            direction: to.transform_vector3(self.direction),
        }
    }
}

/// The first surface that a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in units of the ray's direction.
    pub t: f64,
    /// Index into the scene's objects.
    pub object: usize,
    /// Index into the mesh's triangles.
    pub triangle: u32,
    /// Weights of the triangle's second and third vertex.
    pub weights: [f64; 2],
    /// Frames relative to the instant; a deforming mesh has its shape of that time.
    pub time: f64,
}
