//! The point where a ray meets the scene.

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
