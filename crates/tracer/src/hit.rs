//! The hit of a ray, and the distances within which surfaces are one.

/// Offset of secondary rays from their surface, as a part of the greatest coordinate. Positions are
/// exact to about 1e-14 of it.
pub const LIFT: f64 = 1e-9;

/// Relative difference of distances below which two surfaces are in one place: rounding of their
/// positions to 32 bits.
pub const IN_ONE_PLACE: f64 = 1e-6;

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
