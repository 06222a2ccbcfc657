//! Bleed: mass where the truth never shows the object.

use frame::{Plane, Raster};

use crate::object::mover::Silhouette;
use crate::object::sides::Side;

/// Bleed in pixels of silhouette growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bleed {
    /// Bleed beside the support, over the length of both lateral silhouettes.
    pub lateral: f64,
    /// Bleed ahead of it, over the width across the motion.
    pub leading: f64,
    /// Bleed behind it, over the same width.
    pub trailing: f64,
}

/// Pools the matte outside the support by side. `None` if the object shows no silhouette in the picture.
pub fn measure_bleed(
    output: &Plane,
    sides: &Raster<Side>,
    silhouette: &Silhouette,
) -> Option<Bleed> {
    let on = |wanted: Side| -> f64 {
        output
            .pixels
            .iter()
            .zip(&sides.pixels)
            .filter(|(_, side)| **side == wanted)
            .map(|(matte, _)| f64::from(*matte))
            .sum()
    };
    (silhouette.lateral > 0.0 && silhouette.across > 0.0).then(|| Bleed {
        lateral: on(Side::Lateral) / silhouette.lateral,
        leading: on(Side::Leading) / silhouette.across,
        trailing: on(Side::Trailing) / silhouette.across,
    })
}
