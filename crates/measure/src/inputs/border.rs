//! Content beyond the border of the picture.

use frame::{Frame, Raster};

use crate::named;

/// Widest filled border, in pixels.
const WIDEST: u32 = 256;

named! {
    /// Content beyond the border of the picture.
    pub enum Border {
        /// The filter's own choice.
        Leave = "leave",
        /// The outermost pixels again, as far as the longest smear reaches.
        Clamp = "clamp",
    }
}

/// Returns the width of the border that a frame's longest smear reaches, in pixels.
pub(crate) fn smear_margin(frame: &Frame) -> u32 {
    longest_smear(frame).ceil().min(f64::from(WIDEST)) as u32
}

/// Measures how many pixels the fastest pixel covers while the shutter is open.
fn longest_smear(frame: &Frame) -> f64 {
    let speeds = frame.velocity.pixels.iter().map(|v| v[0].hypot(v[1]));
    f64::from(speeds.fold(0.0, f32::max)) * frame.exposure
}

/// Repeats the outermost pixels of a raster on every side.
pub(crate) fn wide<T: Clone>(raster: &Raster<T>, margin: u32) -> Raster<T> {
    let inside = |place: u32, side: u32| place.saturating_sub(margin).min(side - 1);
    let [width, height] = [raster.width, raster.height];
    Raster::from_fn(width + 2 * margin, height + 2 * margin, |x, y| {
        raster.at(inside(x, width), inside(y, height)).clone()
    })
}

/// Repeats the outermost pixels of a frame on every side, as part of the guard band.
pub(crate) fn repeat_border(frame: &Frame, margin: u32) -> Frame {
    Frame {
        guard_band: frame.guard_band + margin,
        color: wide(&frame.color, margin),
        velocity: wide(&frame.velocity, margin),
        velocity_next: (frame.velocity_next.as_ref()).map(|velocity| wide(velocity, margin)),
        velocity_z: (frame.velocity_z.as_ref()).map(|velocity| wide(velocity, margin)),
        depth: wide(&frame.depth, margin),
        object_id: wide(&frame.object_id, margin),
        coverage: (frame.coverage.iter())
            .map(|plane| wide(plane, margin))
            .collect(),
        samples: frame.samples.as_ref().map(|plane| wide(plane, margin)),
        ..frame.clone()
    }
}
