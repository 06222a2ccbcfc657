//! Both modes of Babylon.js's motion blur.

use super::{Steady, Tap, nearest, tap, tap_here};
use crate::vector::{direction, length, scaled};

/// Most taps.
const SAMPLES: f64 = 32.0;

/// Places the taps of the object based mode: the pixel itself, and one per pixel of distance after
/// the first.
pub fn by_object(steady: &Steady) -> Vec<Tap> {
    let (step, count) = steps(steady);
    let first = 0.5 - 0.5 * count;
    let distances = (1..count as u32).map(|i| first + f64::from(i));
    with_nearest(distances.map(|distance| scaled(step, distance)))
}

/// Returns the trail of the object based mode: as many whole pixels as the motion has, up to 32.
pub fn babylon_trail(steady: &Steady) -> [f64; 2] {
    let (step, count) = steps(steady);
    scaled(step, count)
}

/// Places the taps of the screen based mode, if only the camera moves: along all of the motion,
/// from behind.
pub fn by_camera(steady: &Steady) -> Vec<Tap> {
    let trail = steady.trail();
    let count = length(trail).clamp(1.0, SAMPLES).floor();
    let parts = (1..count as u32).map(|i| 0.5 - f64::from(i) / (count - 1.0));
    with_nearest(parts.map(|part| scaled(trail, part)))
}

/// Returns a vector of one pixel, and the number of taps. Its direction is the motion's in parts of
/// width and height.
fn steps(steady: &Steady) -> ([f64; 2], f64) {
    let [width, height] = steady.size();
    let [x, y] = steady.velocity;
    let stored = [x / width, y / height].map(packed);
    let motion = scaled(stored, steady.exposure);
    let pixels = length([motion[0] * width, motion[1] * height]);
    let count = pixels.clamp(1.0, SAMPLES).floor();
    (direction(motion, [1.0, 0.0]), count)
}

/// Rounds a part of width or height to 8 bits of its cube root, as stored.
fn packed(part: f64) -> f64 {
    let bits = ((0.5 * part.cbrt() + 0.5) * 255.0).round() / 255.0;
    (2.0 * bits - 1.0).powi(3)
}

/// Reads the pixel itself and the nearest ones to these offsets. Between two equally near ones, the
/// last bit of a float decides: each counts half.
fn with_nearest(offsets: impl Iterator<Item = [f64; 2]>) -> Vec<Tap> {
    let taps = offsets.flat_map(|[x, y]| {
        let [columns, rows] = [nearest_two(x), nearest_two(y)];
        columns.map(|x| rows.map(|y| [x, y])).concat()
    });
    let taps = taps.map(|offset| tap(offset, 0.25));
    [tap_here(1.0)].into_iter().chain(taps).collect()
}

fn nearest_two(offset: f64) -> [f64; 2] {
    [nearest(offset - 1e-3), nearest(offset + 1e-3)]
}
