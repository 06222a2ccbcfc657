//! Axis-aligned bounding boxes in `f64`.

use glam::DVec3;

/// A box; empty when `min` exceeds `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
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
