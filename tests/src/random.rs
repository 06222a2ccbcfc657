//! Random numbers by formula, the same on every machine.

use glam::DVec3;

/// Stream of numbers. Streams of different seeds share nothing in their first four thousand million
/// draws.
pub struct Random(u64);

impl Random {
    /// Starts the stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed << 32)
    }

    /// Draws a uniform number in [low, high).
    pub fn real(&mut self, low: f32, high: f32) -> f32 {
        self.0 = self.0.wrapping_add(1);
        let unit = (hash(self.0) >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }
}

/// Stream of numbers in double precision; as in [`Random`], its seeds are multiples of 2^32.
pub struct Numbers(pub u64);

impl Numbers {
    /// Draws a uniform number in [-1, 1).
    #[expect(clippy::should_implement_trait, reason = "a stream without end")]
    pub fn next(&mut self) -> f64 {
        self.0 += 1;
        (hash(self.0) >> 11) as f64 / 2f64.powi(52) - 1.0
    }

    /// Draws a uniform point in a cube about the origin.
    pub fn vector(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| self.next()))
    }
}

/// Hashes by SplitMix64 (Steele, Lea and Flood 2014).
pub fn hash(key: u64) -> u64 {
    let mut z = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
