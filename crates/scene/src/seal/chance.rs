//! Numbers from a seed.

use std::ops::RangeInclusive;

/// Numbers that a seed and a name give, the same everywhere.
pub struct Chance(blake3::OutputReader);

impl Chance {
    /// The numbers of a seed and a name.
    pub fn new(seed: u64, name: &str) -> Self {
        let text = format!("sealed variant {seed} of {name}");
        Self(blake3::Hasher::new().update(text.as_bytes()).finalize_xof())
    }

    /// The next number, uniform in a range.
    pub fn between(&mut self, range: RangeInclusive<f64>) -> f64 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        let unit = (u64::from_le_bytes(bytes) >> 11) as f64 / (1u64 << 53) as f64;
        range.start() + unit * (range.end() - range.start())
    }
}
