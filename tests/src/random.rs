//! Random numbers by formula: the same on every machine.

use crate::synthetic::hash;

/// A stream of numbers; streams of different seeds share nothing in their first four thousand million draws.
pub struct Random(u64);

impl Random {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed << 32)
    }

    /// Uniform in [low, high).
    pub fn real(&mut self, low: f32, high: f32) -> f32 {
        self.0 = self.0.wrapping_add(1);
        let unit = (hash(self.0) >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }
}
