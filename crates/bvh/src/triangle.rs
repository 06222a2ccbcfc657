//! The crossing of a ray and a triangle, without gaps between neighbours.

use glam::DVec3;

use crate::ray::Ray;

/// A ray's crossing of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance in units of the ray's direction; may be negative.
    pub t: f64,
    /// Weight of the second vertex.
    pub u: f64,
    /// Weight of the third vertex.
    pub v: f64,
}

/// Rounding of a weight, as a part of the squared greatest length times the direction's: each of a
/// few dozen operations errs by 1.1e-16 of at most that.
const ROUNDING: f64 = 1e-14;

/// Part of the greatest length by which a crossing may be behind the origin. Rounding is a
/// thousandth of it.
const BEHIND: f64 = 1e-12;

/// Crosses a triangle from either side; its border belongs to it. None if the crossing is behind
/// the ray by more than rounding.
///
/// Edge functions in `f64` (Woop, Benthin and Wald 2013 discuss the sheared form). Two triangles
/// that share an edge compute its function from the same vertices with exactly the opposite sign,
/// so at least one of them accepts. Around a vertex that is not enough: rounding could make every
/// triangle there refuse the ray. A sign in doubt is therefore decided exactly, for one and the
/// same line (Shewchuk 1997, adaptive predicates).
#[inline(always)]
pub fn cross(ray: &Ray, corners: [DVec3; 3]) -> Option<Crossing> {
    let [a, b, c] = corners;
    let [a, b, c] = [a - ray.origin, b - ray.origin, c - ray.origin];
    let mut weights = [
        c.cross(b).dot(ray.direction),
        a.cross(c).dot(ray.direction),
        b.cross(a).dot(ray.direction),
    ];
    let longest = a.abs().max(b.abs()).max(c.abs()).max(ray.origin.abs());
    let squared = longest.max_element() * longest.max_element();
    let doubt = ROUNDING * squared * ray.direction.abs().max_element();
    let least = |weights: &[f64; 3]| weights[0].min(weights[1]).min(weights[2]);
    let greatest = |weights: &[f64; 3]| weights[0].max(weights[1]).max(weights[2]);
    if least(&weights) < -doubt && greatest(&weights) > doubt {
        return None;
    }
    if weights.iter().any(|weight| weight.abs() <= doubt) {
        weights = exact_weights(ray, corners);
    }
    let total: f64 = weights.iter().sum();
    if (least(&weights) < 0.0 && greatest(&weights) > 0.0) || total == 0.0 {
        return None;
    }
    // Tested before the divisions: a ray that leaves a surface has it right behind its origin.
    let [wa, wb, wc] = weights;
    let along = (wa * a + wb * b + wc * c).dot(ray.direction) * total.signum();
    if along < -BEHIND * longest.max_element() * ray.direction.abs().max_element() * total.abs() {
        return None;
    }
    let [wa, wb, wc] = [wa / total, wb / total, wc / total];
    // A weighted mean of the vertices' distances stays between them, however thin the triangle.
    let t = (wa * a + wb * b + wc * c).dot(ray.direction) / ray.direction.length_squared();
    Some(Crossing { t, u: wb, v: wc })
}

/// The three weights with their exact signs.
#[cold]
fn exact_weights(ray: &Ray, corners: [DVec3; 3]) -> [f64; 3] {
    let [origin, ahead] = [ray.origin, ray.at(1.0)].map(coordinates);
    let [a, b, c] = corners.map(coordinates);
    let weight = |from, to| -robust::orient3d(from, to, ahead, origin);
    [weight(b, c), weight(c, a), weight(a, b)]
}

fn coordinates(DVec3 { x, y, z }: DVec3) -> robust::Coord3D<f64> {
    robust::Coord3D { x, y, z }
}
