//! Points of a thin lens.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec2;
use scene::Lens;

/// A point of a camera's lens, in metres from its centre; +x right, +y up. A pinhole has only the
/// centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LensPoint(pub DVec2);

impl LensPoint {
    pub const CENTRE: Self = Self(DVec2::ZERO);

    /// The point of a lens for two numbers in [0, 1). Uniform numbers give points that are uniform
    /// over the disc.
    pub fn new(lens: &Lens, numbers: [f64; 2]) -> Self {
        Self(0.5 * lens.aperture * map_to_disc(numbers))
    }
}

/// Maps the unit square to the unit disc: equal areas to equal areas, and neighbours to neighbours
/// (Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square").
fn map_to_disc(numbers: [f64; 2]) -> DVec2 {
    let [a, b] = numbers.map(|number| 2.0 * number - 1.0);
    if a == 0.0 && b == 0.0 {
        return DVec2::ZERO;
    }
    let (radius, angle) = if a.abs() > b.abs() {
        (a, FRAC_PI_4 * (b / a))
    } else {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    };
    radius * DVec2::from_angle(angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stay_neighbours() {
        let step = 1e-4;
        for index in 0..10_000u32 {
            let numbers = [
                f64::from(index % 100) / 100.0,
                f64::from(index / 100) / 100.0,
            ];
            let moved = numbers.map(|number| number + 0.5 * step);
            let apart = map_to_disc(numbers).distance(map_to_disc(moved));
            assert!(apart < 4.0 * step, "{numbers:?}");
        }
    }
}
