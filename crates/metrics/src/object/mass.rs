//! Mass of an object's matte, and holes in its core.

use frame::{Plane, Raster};

use crate::math::pooling::mean;

/// Mass of a whole matte.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mean of `1 - a` over the core; `None` if that is empty.
    pub hole: Option<f64>,
    /// Missing mass over the truth's mass.
    pub deficit: f64,
    /// Mass over the truth's mass: 1 = kept.
    pub energy: f64,
}

/// Compares sums of mattes; `core` is where the object is seen throughout the shutter. `None` if the truth never shows the
/// object.
pub fn measure_mass(output: &Plane, truth: &Plane, core: &Raster<bool>) -> Option<Mass> {
    let pairs = || {
        output
            .pixels
            .iter()
            .zip(&truth.pixels)
            .map(|(a, b)| (f64::from(*a), f64::from(*b)))
    };
    let total: f64 = pairs().map(|(_, truth)| truth).sum();
    let missing: Vec<f64> = (output.pixels.iter().zip(&core.pixels))
        .filter_map(|(output, inside)| inside.then_some(1.0 - f64::from(*output)))
        .collect();
    (total > 0.0).then(|| Mass {
        hole: mean(&missing),
        deficit: pairs().map(|(a, truth)| (truth - a).max(0.0)).sum::<f64>() / total,
        energy: pairs().map(|(a, _)| a).sum::<f64>() / total,
    })
}
