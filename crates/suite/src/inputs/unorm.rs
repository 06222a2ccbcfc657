//! Normalised integers, as buffers of few bits hold them.

/// Rounds a number in [0, 1] to a number of bits.
pub(crate) fn unorm(value: f64, bits: u32) -> f64 {
    let steps = f64::from((1_u32 << bits) - 1);
    (value.clamp(0.0, 1.0) * steps).round() / steps
}
