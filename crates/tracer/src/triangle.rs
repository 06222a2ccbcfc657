//! Where a ray crosses a triangle, without gaps between neighbours.

use glam::DVec3;

use crate::ray::Ray;

/// A ray's crossing of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Distance in units of the ray's direction; may be negative.
    pub t: f64,
    /// Weight of the second vertex.
    pub u: f64,
    /// Weight of the third vertex.
    pub v: f64,
}

/// Crosses a triangle from either side; its border belongs to it.
///
/// Edge functions in `f64` (Woop, Benthin and Wald 2013 discuss the sheared form). Two triangles that share an edge
/// compute its function from the same vertices with exactly the opposite sign, so at least one of them accepts.
#[inline]
pub(crate) fn cross(ray: &Ray, [a, b, c]: [DVec3; 3]) -> Option<Crossing> {
    let [a, b, c] = [a - ray.origin, b - ray.origin, c - ray.origin];
    let weight_a = c.cross(b).dot(ray.direction);
    let weight_b = a.cross(c).dot(ray.direction);
    if weight_a * weight_b < 0.0 {
        return None;
    }
    let weight_c = b.cross(a).dot(ray.direction);
    let least = weight_a.min(weight_b).min(weight_c);
    let greatest = weight_a.max(weight_b).max(weight_c);
    let total = weight_a + weight_b + weight_c;
    if (least < 0.0 && greatest > 0.0) || total == 0.0 {
        return None;
    }
    let [wa, wb, wc] = [weight_a / total, weight_b / total, weight_c / total];
    // A weighted mean of the vertices' distances stays between them, however thin the triangle.
    let t = (wa * a + wb * b + wc * c).dot(ray.direction) / ray.direction.length_squared();
    Some(Crossing { t, u: wb, v: wc })
}
