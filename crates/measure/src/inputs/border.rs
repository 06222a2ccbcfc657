//! Content beyond the border of the picture.

use frame::Frame;

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

/// Repeats the outermost pixels of a frame on every side, as part of the guard band.
pub(crate) fn repeat_border(frame: &Frame, margin: u32) -> Frame {
    Frame {
        guard_band: frame.guard_band + margin,
        color: frame.color.widened(margin),
        velocity: frame.velocity.widened(margin),
        velocity_next: (frame.velocity_next.as_ref()).map(|velocity| velocity.widened(margin)),
        velocity_z: (frame.velocity_z.as_ref()).map(|velocity| velocity.widened(margin)),
        depth: frame.depth.widened(margin),
        object_id: frame.object_id.widened(margin),
        coverage: (frame.coverage.iter())
            .map(|plane| plane.widened(margin))
            .collect(),
        samples: frame.samples.as_ref().map(|plane| plane.widened(margin)),
        ..frame.clone()
    }
}
