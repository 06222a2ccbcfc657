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
    let (mut lateral, mut leading, mut trailing) = (0.0, 0.0, 0.0);
    for (matte, side) in output.pixels.iter().zip(&sides.pixels) {
        match side {
            Side::Inside => (),
            Side::Lateral => lateral += f64::from(*matte),
            Side::Leading => leading += f64::from(*matte),
            Side::Trailing => trailing += f64::from(*matte),
        }
    }
    (silhouette.lateral > 0.0 && silhouette.across > 0.0).then(|| Bleed {
        lateral: lateral / silhouette.lateral,
        leading: leading / silhouette.across,
        trailing: trailing / silhouette.across,
    })
}
