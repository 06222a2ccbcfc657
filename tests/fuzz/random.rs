//! Random numbers by formula, which give the same inputs on every machine.

/// Stream of numbers: SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(u64);

impl Random {
    /// Starts the stream of one case of a target.
    pub fn of_case(seed: u64, target: &str, case: u64) -> Self {
        let name = target.bytes().fold(seed, |state, byte| {
            hash(state.wrapping_add(u64::from(byte)))
        });
        Self(hash(name.wrapping_add(case)))
    }

    /// Draws any number.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        hash(self.0)
    }

    /// Draws a number below `count`, which is at least 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// Returns true in one of `count` draws.
    pub fn once_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// Draws a number from 1 to `most`; small numbers are as likely as large ones.
    pub fn magnitude(&mut self, most: usize) -> usize {
        let bits = 1 + self.below(most.ilog2() as usize + 1);
        (1 + self.below(1 << bits)).min(most)
    }

    /// Picks one of several values.
    pub fn pick<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}

fn hash(key: u64) -> u64 {
    let mut z = key;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
