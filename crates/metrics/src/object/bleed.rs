//! Bleed: mass where the truth never shows the object.

use frame::{Plane, Raster};

use crate::object::mover::Silhouette;
use crate::object::sides::Side;

/// Mass outside the support by side, in pixels of silhouette growth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bleed {
    /// Beside it.
    pub lateral: f64,
    /// Ahead of it.
    pub leading: f64,
    /// Behind it.
    pub trailing: f64,
}

/// Pools the matte outside the support by side: beside it over the length of both lateral silhouettes, ahead of it and behind it over the width across the motion.
/// `None` if the object shows no silhouette in the picture.
pub fn measure_bleed(
    output: &Plane,
    sides: &Raster<Side>,
    silhouette: &Silhouette,
) -> Option<Bleed> {
    let mut masses = [0.0; 4];
    for (matte, side) in output.pixels.iter().zip(&sides.pixels) {
        masses[*side as usize] += f64::from(*matte);
    }
    let mass = |side: Side| masses[side as usize];
    let Silhouette {
        lateral: length,
        across,
    } = *silhouette;
    (length > 0.0 && across > 0.0).then(|| Bleed {
        lateral: mass(Side::Lateral) / length,
        leading: mass(Side::Leading) / across,
        trailing: mass(Side::Trailing) / across,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bleed_is_mass_per_length_of_its_side() {
        let output = Plane {
            width: 4,
            height: 1,
            pixels: vec![1.0, 0.5, 0.25, 0.125],
        };
        let sides = Raster {
            width: 4,
            height: 1,
            pixels: vec![Side::Inside, Side::Lateral, Side::Leading, Side::Trailing],
        };
        let measure = |lateral, across| {
            let silhouette = Silhouette { lateral, across };
            measure_bleed(&output, &sides, &silhouette)
        };
        assert_eq!(
            measure(2.0, 4.0),
            Some(Bleed {
                lateral: 0.25,
                leading: 0.0625,
                trailing: 0.03125,
            })
        );
        assert_eq!(measure(0.0, 4.0), None);
        assert_eq!(measure(2.0, 0.0), None);
    }
}
