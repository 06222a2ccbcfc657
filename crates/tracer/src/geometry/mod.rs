//! Rays, boxes, balls and triangles, and the hit of a ray.

pub(crate) mod aabb;
pub(crate) mod ball;
pub(crate) mod ray;
pub(crate) mod triangle;
