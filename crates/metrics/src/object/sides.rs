//! Side of an object's motion that each pixel is on.

use std::collections::HashMap;

use frame::{Frame, Raster, Support};

use crate::object::mover::{Directions, Mover};
use crate::object::nearest::{distance_squared, find_nearest, find_on_circle, list_circle};

/// Side of the swept support that a pixel is on, as seen along the motion of the nearest part of
/// it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In the support or next to it, where nothing counts as bleed.
    Inside,
    /// Beside it: within 45 degrees of the motion's normal.
    Lateral,
    /// Ahead of it.
    Leading,
    /// Behind it.
    Trailing,
}

/// Finds the side of the support that every pixel is on; `None` if the object is never seen. The
/// support is where the object was seen while the shutter was open, and one pixel more for partial
/// pixels of a rounded edge. `directions` has the unit vector of motion for each pixel of the
/// support.
///
/// Every pixel is lateral to one without direction (the centre of a rotation). Equally near parts
/// of the support decide together, by the sum of their offsets and the sum of their directions.
pub fn find_sides(support: &Raster<bool>, directions: &Directions) -> Option<Raster<Side>> {
    let sources = find_nearest(support)?;
    // Straight outlines have whole rows of pixels at one distance.
    let mut circles: HashMap<u64, Vec<[i64; 2]>> = HashMap::new();
    Some(Raster::from_fn(support.width, support.height, |x, y| {
        let distance = distance_squared([x, y], *sources.at(x, y));
        // The eight neighbours of the support are still inside.
        if distance <= 2 {
            return Side::Inside;
        }
        let (mut away, mut along) = ([0.0; 2], [0.0; 2]);
        let offsets = (circles.entry(distance)).or_insert_with(|| list_circle(distance));
        for [u, v] in find_on_circle(support, [x, y], offsets) {
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

/// Finds the side of object `id` that each pixel is on, as for its bleed; `None` if the object is
/// not seen at the instant, does not move, or never shows. `frame` has no guard band, `support` is
/// the truth's.
pub fn object_sides(frame: &Frame, support: &Support, id: u32) -> Option<Raster<Side>> {
    let (_, directions) = Mover::new(frame, id).ok()?;
    find_sides(&support.seen[id as usize], &directions)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the side that each offset from a single pixel is on, which moves along a direction.
    fn sides<const N: usize>(direction: [f64; 2], offsets: [[i32; 2]; N]) -> [Side; N] {
        let support = Raster::from_fn(17, 17, |x, y| (x, y) == (8, 8));
        let sides = find_sides(&support, &Raster::filled(17, 17, direction)).unwrap();
        offsets.map(|[x, y]| *sides.at((8 + x) as u32, (8 + y) as u32))
    }

    #[test]
    fn sides_meet_at_45_degrees_to_the_motion() {
        use Side::{Inside, Lateral, Leading, Trailing};
        let right = [1.0, 0.0];
        assert_eq!(sides(right, [[0, 0], [1, 0], [1, 1], [-1, 1]]), [Inside; 4]);
        assert_eq!(sides(right, [[2, 0], [3, 2], [3, -2]]), [Leading; 3]);
        assert_eq!(sides(right, [[-2, 0], [-3, 2], [-3, -2]]), [Trailing; 3]);
        assert_eq!(
            sides(right, [[0, 2], [2, 3], [-2, 3], [2, -3]]),
            [Lateral; 4]
        );
        // 16 degrees from the motion, then 90.
        assert_eq!(sides([0.6, 0.8], [[4, 3], [4, -3]]), [Leading, Lateral]);
    }
}
