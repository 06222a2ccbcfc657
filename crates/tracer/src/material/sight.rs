//! The surfaces that a ray takes notice of.

/// The translucent surfaces that a ray sees; opaque ones it always sees, holes never.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sight {
    /// All that change the light.
    Everything,
    /// Those that velocity, depth and object id are taken of.
    Buffers,
    /// None.
    Opaque,
}
