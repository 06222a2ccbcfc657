//! Points of a thin lens.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec2;

use crate::scene::Lens;

/// A point of a camera's lens, in metres from its centre; +x right, +y up. A pinhole has none but the centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LensPoint(pub DVec2);

impl LensPoint {
    pub const CENTRE: Self = Self(DVec2::ZERO);
}

impl Lens {
    /// The point of the lens for two numbers in [0, 1). Even numbers give points that are even over the disc.
    pub(crate) fn point(&self, numbers: [f64; 2]) -> LensPoint {
        LensPoint(0.5 * self.aperture * map_to_disc(numbers))
    }
}

/// Maps the unit square to the unit disc: equal areas to equal areas, and neighbours to neighbours (Shirley and Chiu 1997, "A Low
/// Distortion Map Between Disk and Square").
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

    const SIDE: u32 = 256;

    fn for_each_point(mut visit: impl FnMut(DVec2)) {
        for index in 0..SIDE * SIDE {
            let numbers = [index % SIDE, index / SIDE]
                .map(|place| (f64::from(place) + 0.5) / f64::from(SIDE));
            visit(map_to_disc(numbers));
        }
    }

    #[test]
    fn a_grid_of_numbers_fills_every_part_of_the_disc_in_proportion_to_its_area() {
        // Rings and sectors of equal area.
        let mut rings = [0u32; 8];
        let mut sectors = [0u32; 8];
        for_each_point(|point| {
            assert!(point.length() < 1.0, "{point}");
            rings[(8.0 * point.length_squared()) as usize] += 1;
            let turn = point.to_angle() / std::f64::consts::TAU;
            sectors[(8.0 * turn.rem_euclid(1.0)) as usize % 8] += 1;
        });
        let each = f64::from(SIDE * SIDE) / 8.0;
        for count in rings.into_iter().chain(sectors) {
            // A border is crossed by a row of the grid at most, of 256 on each of four sides.
            assert!(
                (f64::from(count) - each).abs() < 1100.0,
                "{rings:?} {sectors:?}"
            );
        }
    }

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
