//! Positions and times of a pixel's samples.

use crate::random::hash;

/// Number and seed of a picture's samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Samples per pixel.
    pub samples: u32,
    /// Seed of the per-pixel offsets. Without a seed every pixel has the same offset, and renders
    /// do not differ in noise.
    pub seed: Option<u64>,
}

impl Sampling {
    /// Noise-free: every render of one scene gives the same values.
    pub const CLEAN: Sampling = Sampling {
        samples: 256,
        seed: None,
    };
}

/// Returns sample `index` of `count` in the unit cube: time stratified, the pixel filled by the R2
/// sequence (Martin Roberts 2018, on the plastic number), each dimension rotated by an offset.
pub(crate) fn sequence(index: u32, count: u32, offsets: [f64; 3]) -> [f64; 3] {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let k = f64::from(index) + 0.5;
    // No value is negative, so that a cast is a floor, and much faster.
    let fraction = |value: f64| value - f64::from(value as u32);
    [
        fraction(k / PLASTIC + offsets[0]),
        fraction(k / (PLASTIC * PLASTIC) + offsets[1]),
        fraction((k + offsets[2]) / f64::from(count)),
    ]
}

pub(crate) fn pixel_offsets(seed: Option<u64>, x: u32, y: u32) -> [f64; 3] {
    match seed {
        None => [0.0; 3],
        Some(seed) => [0, 1, 2].map(|dimension| {
            let key = (seed << 40) ^ (u64::from(y) << 22) ^ (u64::from(x) << 4) ^ dimension;
            // The offset in time stays within half a stratum of the midpoint.
            let offset = (hash(key) >> 11) as f64 / (1u64 << 53) as f64;
            if dimension == 2 { offset - 0.5 } else { offset }
        }),
    }
}
