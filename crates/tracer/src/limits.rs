//! The limits of renders. `docs/limits.md` lists these numbers and those of scenes; a test compares
//! the two.

/// Most samples per pixel of one replicate, as many as the tables of the Sobol sequence have.
pub const MAX_SAMPLES: u32 = 65_536;

/// Greatest coordinate of anything that is rendered, in metres: the areas of boxes must be 32-bit
/// numbers, and positions exact to less than a metre.
pub const LARGEST_COORDINATE: f64 = 1e15;

/// Greatest value of a pixel, in any layer but depth: sums and products of pixels must be 32-bit
/// numbers.
pub const LARGEST_VALUE: f32 = 1e36;
