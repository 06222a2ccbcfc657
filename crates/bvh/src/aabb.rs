//! Axis-aligned bounding boxes in `f64`.

use glam::DVec3;

use crate::ray::Ray;

/// Room for the rounding of distances along a ray.
const SLACK: f64 = 1.0 + 1e-12;

/// A box; empty when `min` exceeds `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least corner, metres.
    pub min: DVec3,
    /// Greatest corner, metres.
    pub max: DVec3,
}

impl Aabb {
    /// A box that contains nothing: the start of a union.
    pub const EMPTY: Aabb = Aabb {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    /// The smallest box around points.
    pub fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |aabb, point| Self {
            min: aabb.min.min(point),
            max: aabb.max.max(point),
        })
    }

    /// The smallest box that contains both.
    pub fn union(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The box with every face moved outwards, in metres.
    pub fn grown(self, by: f64) -> Self {
        Self {
            min: self.min - by,
            max: self.max + by,
        }
    }

    /// Returns true if a ray certainly misses the inside of the box. `inverse` is 1 over its
    /// direction.
    #[inline(always)]
    pub fn is_missed(&self, ray: &Ray, inverse: DVec3) -> bool {
        let [one, other] = [self.min, self.max].map(|corner| (corner - ray.origin) * inverse);
        let enters = one.min(other).max_element();
        let leaves = one.max(other).min_element();
        leaves < 0.0 || enters > leaves * SLACK
    }

    /// Midpoint.
    pub fn centre(self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Distance from the least to the greatest corner, metres.
    pub fn diagonal(self) -> f64 {
        (self.max - self.min).length()
    }

    /// Half the area of its surface, square metres.
    pub fn half_area(self) -> f64 {
        let size = self.max - self.min;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// The greatest absolute coordinate of any corner, metres.
    pub fn largest_coordinate(self) -> f64 {
        self.min.abs().max(self.max.abs()).max_element()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_misses_a_box_unless_it_passes_a_point_inside() {
        let aabb = Aabb::around([DVec3::new(1.0, -2.0, 3.0), DVec3::new(2.0, 2.0, 3.5)]);
        let misses = |origin: DVec3, direction: DVec3| {
            let direction = direction.normalize();
            aabb.is_missed(&Ray { origin, direction }, direction.recip())
        };
        let inside = DVec3::new(1.25, 1.5, 3.4);
        let origins = [DVec3::ZERO, DVec3::new(1.25, 1.5, 9.0), DVec3::splat(1e7)];
        for origin in origins {
            assert!(!misses(origin, inside - origin), "{origin}");
            assert!(misses(origin, origin - inside), "{origin}");
        }
        assert!(!misses(inside, DVec3::NEG_Y));
        assert!(misses(DVec3::ZERO, DVec3::new(1.0, 2.1, 3.0)));
        assert!(misses(DVec3::new(0.9, 0.0, 0.0), DVec3::Z));
    }
}
