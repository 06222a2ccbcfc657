//! Noise from numbers, the same on every machine.

/// A value in [0, 1) for a pair of whole numbers.
pub(crate) fn noise(x: u32, y: u32) -> f64 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77).rotate_left(13);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    f64::from(h) / 2f64.powi(32)
}
