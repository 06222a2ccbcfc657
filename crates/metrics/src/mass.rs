//! Whether a blur keeps the object's mass, and its unblurred core.

use frame::Plane;

/// A matte this close to 1 covers its pixel throughout the shutter: within the rounding of a mean of 32-bit halves.
const FULL: f64 = 1.0 - 1e-6;

/// Sums over a whole matte.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mean of `1 - a` where the truth covers the pixel throughout the shutter; `None` where it covers none so.
    pub hole: Option<f64>,
    /// Missing mass over the truth's mass.
    pub deficit: f64,
    /// Mass over the truth's mass: 1 = kept.
    pub energy: f64,
}

/// Compares sums of mattes; `None` when the truth never shows the object.
pub fn mass(output: &Plane, truth: &Plane) -> Option<Mass> {
    let pairs = || {
        output
            .pixels
            .iter()
            .zip(&truth.pixels)
            .map(|(a, b)| (f64::from(*a), f64::from(*b)))
    };
    let total: f64 = pairs().map(|(_, truth)| truth).sum();
    let core: Vec<f64> = pairs()
        .filter(|(_, truth)| *truth >= FULL)
        .map(|(output, _)| 1.0 - output)
        .collect();
    (total > 0.0).then(|| Mass {
        hole: crate::pooling::mean(&core),
        deficit: pairs().map(|(a, truth)| (truth - a).max(0.0)).sum::<f64>() / total,
        energy: pairs().map(|(a, _)| a).sum::<f64>() / total,
    })
}
