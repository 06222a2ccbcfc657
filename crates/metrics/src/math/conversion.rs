//! Conversions of planes between 32 and 64 bits.

use frame::{Plane, Raster};

/// Converts a plane to `f64`, to be summed.
pub fn widen(plane: &Plane) -> Raster<f64> {
    plane.map(|value| f64::from(*value))
}

/// Rounds a plane to `f32`, to be stored.
pub fn narrow(map: &Raster<f64>) -> Plane {
    map.map(|value| *value as f32)
}
