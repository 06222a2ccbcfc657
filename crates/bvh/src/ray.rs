//! A half-line in `f64`, in the world or in an object's space.

use glam::{DAffine3, DVec3};

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
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// The same ray in another space; `t` is unchanged.
    #[inline]
    pub fn transformed(&self, to: &DAffine3) -> Ray {
        Ray {
            origin: to.transform_point3(self.origin),
            direction: to.transform_vector3(self.direction),
        }
    }
}
