//! Interleaved gradient noise in 64-bit floats.

/// Error in 32-bit floats: 53 times the rounding of a number up to 64, twice.
pub const NOISE: f64 = 4e-4;

/// Computes the noise of a pixel on a cycle of 8 frames, `offset` pixels further right and down; none where it may wrap
/// around.
pub fn noise(pixel: [i64; 2], frame_index: u32, offset: f64) -> Option<f64> {
    let frame = f64::from(frame_index % 8);
    let x = pixel[0] as f64 + frame * 47.0 * 0.695 + offset;
    let y = pixel[1] as f64 + frame * 17.0 * 0.695 + offset;
    let inner = (0.067_110_56 * x + 0.005_837_15 * y).fract();
    let noise = (52.982_918_9 * inner).fract();
    let clear = |value: f64, margin: f64| value > margin && value < 1.0 - margin;
    (clear(inner, NOISE / 50.0) && clear(noise, NOISE)).then_some(noise)
}
