//! Bleed: mass where the truth never shows the object.

use frame::{Plane, Raster};

use crate::object::mover::Silhouette;
use crate::object::sides::Side;

/// Pools the matte outside the support by side, in pixels of silhouette growth: beside it over the length of both lateral silhouettes,
/// ahead of it and behind it over the width across the motion. `None` if the object shows no silhouette in the picture.
pub fn measure_bleed(
    output: &Plane,
    sides: &Raster<Side>,
    silhouette: &Silhouette,
) -> Option<[f64; 3]> {
    let mut masses = [0.0; 4];
    for (matte, side) in output.pixels.iter().zip(&sides.pixels) {
        masses[*side as usize] += f64::from(*matte);
    }
    let [_inside, lateral, leading, trailing] = masses;
    let Silhouette {
        lateral: length,
        across,
    } = *silhouette;
    (length > 0.0 && across > 0.0).then(|| [lateral / length, leading / across, trailing / across])
}
