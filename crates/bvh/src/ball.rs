//! Balls around meshes: rays that miss one skip the mesh, rays from afar start at it.

use glam::DVec3;

use crate::ray::Ray;
use crate::triangle::{Crossing, cross};

/// Room for rounding.
const SLACK: f64 = 1.0 + 1e-6;
/// Radii from the centre within which a ray keeps its origin, because it has the mesh's own
/// magnitude there.
const NEAR: f64 = 8.0;
/// Radii from the centre beyond which the early test gives no answer. There squared distances are
/// rounded by a hundredth of the slack.
const FAR: f64 = 1e4;

/// A ball around a mesh.
pub struct Ball {
    centre: DVec3,
    radius_squared: f64,
}

/// A ray with its origin moved up to a ball, so that it has the ball's own magnitude.
pub struct Approach {
    /// The ray from its moved origin.
    pub ray: Ray,
    /// Distance by which the origin was moved, in units of the direction.
    pub start: f64,
}

impl Ball {
    /// A ball of this radius, in metres.
    #[inline]
    pub fn new(centre: DVec3, radius: f64) -> Self {
        Self {
            centre,
            radius_squared: radius * radius * SLACK,
        }
    }

    /// The smallest ball with this centre that contains the points.
    pub fn around(centre: DVec3, points: impl IntoIterator<Item = DVec3>) -> Self {
        let squares = points
            .into_iter()
            .map(|point| point.distance_squared(centre));
        Self {
            centre,
            radius_squared: squares.fold(0.0, f64::max) * SLACK,
        }
    }

    /// Returns true if a ray certainly misses the ball. From very far away rounding makes that
    /// uncertain.
    #[inline(always)]
    pub fn is_missed(&self, ray: &Ray) -> bool {
        let way = self.centre - ray.origin;
        let distance_squared = way.length_squared();
        let along = way.dot(ray.direction);
        let squared = ray.direction.length_squared();
        let aside_squared = distance_squared * squared - along * along;
        distance_squared > self.radius_squared
            && distance_squared < FAR * FAR * self.radius_squared
            && (along <= 0.0 || aside_squared > self.radius_squared * squared)
    }

    /// Moves a ray up to the ball; none if the ray misses it. A flat mesh may touch its ball at the
    /// border only, so the ball is grown by rounding, never shrunk.
    #[inline(always)]
    pub fn approach(&self, ray: &Ray) -> Option<Approach> {
        let way = self.centre - ray.origin;
        let distance_squared = way.length_squared();
        let along = way.dot(ray.direction);
        let outside = distance_squared > self.radius_squared;
        if outside && along <= 0.0 {
            return None;
        }
        let squared = ray.direction.length_squared();
        if distance_squared <= NEAR * NEAR * self.radius_squared {
            let aside_squared = distance_squared * squared - along * along;
            let misses = outside && aside_squared > self.radius_squared * squared;
            return (!misses).then_some(Approach {
                ray: *ray,
                start: 0.0,
            });
        }
        let nearest = along / squared;
        if ray.at(nearest).distance_squared(self.centre) > self.radius_squared {
            return None;
        }
        let start = (nearest - (self.radius_squared / squared).sqrt()).max(0.0);
        Some(Approach {
            ray: Ray {
                origin: ray.at(start),
                direction: ray.direction,
            },
            start,
        })
    }
}

impl Approach {
    /// A limit on `t`, counted from the moved origin.
    #[inline(always)]
    pub fn local_limit(&self, limit: f64) -> f64 {
        limit - self.start
    }

    /// Crosses a triangle at `0 < t <= limit`, counted from the ray's own origin.
    #[inline(always)]
    pub fn cross(&self, corners: [DVec3; 3], limit: f64) -> Option<Crossing> {
        let mut crossing = cross(&self.ray, corners)?;
        crossing.t += self.start;
        (crossing.t > 0.0 && crossing.t <= limit).then_some(crossing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_is_missed_beside_it_and_behind_and_not_where_it_is_met() {
        let ball = Ball::new(DVec3::new(1.0, 2.0, 3.0), 0.5);
        let ray = |aside: f64, start: f64, length: f64| Ray {
            origin: DVec3::new(1.0 + start, 2.0 + aside, 3.0),
            direction: DVec3::new(length, 0.0, 0.0),
        };
        for length in [1e-3, 1.0, 70.0] {
            for start in [-0.6, -10.0, -1000.0] {
                assert!(!ball.is_missed(&ray(0.49, start, length)));
                assert!(ball.is_missed(&ray(0.51, start, length)));
                assert!(ball.is_missed(&ray(0.49, -start, length)), "behind");
            }
            assert!(!ball.is_missed(&ray(0.49, 0.05, length)), "from inside");
        }
    }
}
