//! Noise from numbers, equal on every machine.

/// White noise in [0, 1) for a pair of whole numbers.
pub(crate) fn noise(x: u32, y: u32) -> f64 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77).rotate_left(13);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    f64::from(h) / 2f64.powi(32)
}

/// Smooth noise in [0, 1) with blobs of `size` texels. It repeats every `period` texels, a multiple
/// of `size`.
pub(crate) fn soft_noise(x: u32, y: u32, size: u32, period: u32) -> f64 {
    let corner = |dx: u32, dy: u32| {
        let cells = period / size;
        noise(
            (x / size + dx) % cells + 101 * size,
            (y / size + dy) % cells,
        )
    };
    let ease = |texel: u32| {
        let part = f64::from(texel % size) / f64::from(size);
        part * part * (3.0 - 2.0 * part)
    };
    let along = |dy| corner(0, dy) + ease(x) * (corner(1, dy) - corner(0, dy));
    along(0) + ease(y) * (along(1) - along(0))
}
