//! Colours that show errors and velocities.

use frame::{Frame, Image, Plane};

/// Shows an error in [0, 1] in the colours of magma; no error is black.
pub fn magma(error: &Plane) -> Image {
    // In 256 steps, so that a PNG of it has a palette.
    let palette: Vec<[f32; 3]> = (0..=u8::MAX)
        .map(|step| colorous::MAGMA.eval_continuous(f64::from(f32::from(step) / 255.0)))
        .map(|color| color.as_array().map(|byte| f32::from(byte) / 255.0))
        .collect();
    error.map(|value| palette[(value.clamp(0.0, 1.0) * 255.0).round() as usize])
}

/// Shows direction as hue and speed as brightness, full at the frame's fastest pixel. Still pixels
/// are black.
pub fn velocity_wheel(frame: &Frame) -> Image {
    let speed = |v: &[f32; 2]| v[0].hypot(v[1]);
    let fastest = frame.velocity.pixels.iter().map(speed).fold(1e-6, f32::max);
    frame.velocity.map(|v| {
        let turn = f64::from(v[1].atan2(v[0])) / std::f64::consts::TAU;
        let hue = colorous::SINEBOW.eval_continuous(turn.rem_euclid(1.0));
        hue.as_array()
            .map(|byte| f32::from(byte) / 255.0 * speed(v) / fastest)
    })
}
