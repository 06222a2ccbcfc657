//! Rays, boxes, balls, triangles, and where a ray meets a surface.

pub(crate) mod aabb;
pub(crate) mod ball;
pub(crate) mod ray;
pub(crate) mod triangle;
