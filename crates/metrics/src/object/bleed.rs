//! Mass where the truth never shows the object.

use std::collections::HashMap;

use frame::{Plane, Raster};

use crate::object::mover::Silhouette;
use crate::object::nearest::{circle, distance_squared, nearest, on_circle};

/// On which side of the swept support a pixel lies, as seen along the motion of the nearest part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In the support or next to it: no bleed.
    Inside,
    /// Beside it: within 45 degrees of the motion's normal.
    Lateral,
    /// Ahead of it.
    Leading,
    /// Behind it.
    Trailing,
}

/// Hard bleed in pixels of silhouette growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bleed {
    /// Beside the support, over the length of both lateral silhouettes.
    pub lateral: f64,
    /// Ahead of it, over the width across the motion.
    pub leading: f64,
    /// Behind it, over the same width.
    pub trailing: f64,
}

/// Sorts every pixel by where it lies from the support, which is where the object was seen while the shutter was open, and
/// reaches one pixel further: partial pixels of a rounded edge. `directions` holds the unit vector of motion to judge each
/// pixel of the support by.
///
/// A pixel without direction (the centre of a rotation) has everything beside it. Equally near parts of the support decide
/// together, by the sum of their offsets and the sum of their directions. `None` when the object is never seen.
pub fn sides(support: &Raster<bool>, directions: &Raster<[f64; 2]>) -> Option<Raster<Side>> {
    let nearest = nearest(support)?;
    // Straight outlines have whole rows of pixels at one distance.
    let mut circles: HashMap<u64, Vec<[i64; 2]>> = HashMap::new();
    Some(Raster::from_fn(support.width, support.height, |x, y| {
        let distance = distance_squared([x, y], *nearest.at(x, y));
        // The eight neighbours of the support are still inside.
        if distance <= 2 {
            return Side::Inside;
        }
        let (mut away, mut along) = ([0.0; 2], [0.0; 2]);
        let circle = (circles.entry(distance)).or_insert_with(|| circle(distance));
        for [u, v] in on_circle(support, [x, y], circle) {
            let offset = [f64::from(x) - f64::from(u), f64::from(y) - f64::from(v)];
            let direction = *directions.at(u, v);
            away = [0, 1].map(|axis| away[axis] + offset[axis]);
            along = [0, 1].map(|axis| along[axis] + direction[axis]);
        }
        let ahead = away[0] * along[0] + away[1] * along[1];
        let beside = (away[1] * along[0] - away[0] * along[1]).abs();
        if ahead > beside {
            Side::Leading
        } else if -ahead > beside {
            Side::Trailing
        } else {
            Side::Lateral
        }
    }))
}

/// Pools the matte outside the support by side. `None` when the object shows no silhouette in the picture.
pub fn bleed(output: &Plane, sides: &Raster<Side>, silhouette: &Silhouette) -> Option<Bleed> {
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
