//! Rays moved up to what they may meet, so that single precision suffices to search it.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::ray::Ray;

/// Room for rounding when a ray is moved up to a sphere.
const SLACK: f64 = 1.0 + 1e-6;

/// A sphere around a mesh, in its own space.
pub(crate) struct Sphere {
    centre: DVec3,
    radius: f64,
}

/// A ray whose origin is of the mesh's own magnitude.
pub(crate) struct Approach {
    pub ray: Ray,
    /// The unit direction.
    pub heading: DVec3,
    /// What was taken off `t`, in units of the direction.
    pub start: f64,
    /// Length of the direction.
    length: f64,
}

impl Sphere {
    /// Around a box.
    pub fn around(bounds: Bounds) -> Self {
        Self {
            centre: bounds.centre(),
            radius: 0.5 * bounds.diagonal() * SLACK,
        }
    }

    /// The greatest coordinate within, metres: that of approached origins too.
    pub fn reach(&self) -> f64 {
        self.centre.abs().max_element() + self.radius
    }

    /// None where the ray, whose direction has a known length, misses the sphere.
    #[inline(always)]
    pub fn approach(&self, ray: &Ray, length: f64) -> Option<Approach> {
        let shorter = 1.0 / length;
        let heading = shorter * ray.direction;
        let nearest = (self.centre - ray.origin).dot(heading);
        let miss = (ray.origin + nearest * heading).distance_squared(self.centre);
        // A flat mesh may fill its sphere's equator only: the sphere is grown, never shrunk, by rounding.
        if miss > self.radius * self.radius * SLACK {
            return None;
        }
        let start = ((nearest - self.radius) * shorter).max(0.0);
        Some(Approach {
            ray: Ray {
                origin: ray.at(start),
                direction: ray.direction,
            },
            heading,
            start,
            length,
        })
    }
}

impl Approach {
    /// A limit on `t` as a distance from the approached origin.
    #[inline(always)]
    pub fn local(&self, limit: f64) -> f64 {
        (limit - self.start) * self.length
    }
}
