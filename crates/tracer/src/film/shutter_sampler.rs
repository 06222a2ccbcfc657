//! Times within a shutter interval, in proportion to the shutter's efficiency.

use frame::{Shutter, ShutterProfile};

/// Draws times from a shutter by its cumulative efficiency.
#[derive(Clone, Debug)]
pub(crate) struct ShutterSampler {
    shutter: Shutter,
    profile: ShutterProfile,
    pieces: Vec<Piece>,
    /// Integral of the efficiency over the interval, whose length counts as 1.
    total: f64,
}

/// A part of the interval in which the efficiency is linear.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Start and length, as parts of the interval.
    start: f64,
    length: f64,
    /// Efficiencies at both ends.
    efficiencies: [f64; 2],
    /// Integral of the efficiency up to the end of the piece.
    until: f64,
}

impl ShutterSampler {
    pub fn new(shutter: Shutter, profile: &ShutterProfile) -> Self {
        let mut total = 0.0;
        let pieces = profile
            .efficiency
            .knots()
            .windows(2)
            .map(|ends| {
                let [[start, first], [end, last]] = [ends[0], ends[1]];
                let length = end - start;
                total += 0.5 * (first + last) * length;
                Piece {
                    start,
                    length,
                    efficiencies: [first, last],
                    until: total,
                }
            })
            .collect();
        Self {
            shutter,
            profile: profile.clone(),
            pieces,
            total,
        }
    }

    /// The time, in frames, by which `part` of all light of a row has passed; `part` is in [0, 1).
    pub fn time(&self, part: f64, row: u32, height: u32) -> f64 {
        self.shutter.at(self.place(part * self.total)) + self.profile.row_offset(row, height)
    }

    /// The part of the interval after which the efficiency's integral is `sum`.
    fn place(&self, sum: f64) -> f64 {
        let index = self.pieces.partition_point(|piece| piece.until <= sum);
        // Rounding may lead past the last piece.
        let piece = self.pieces[index.min(self.pieces.len() - 1)];
        let [first, last] = piece.efficiencies;
        let before = piece.until - 0.5 * (first + last) * piece.length;
        let rest = (sum - before).max(0.0);
        // first s + (last - first) s^2 / (2 length) = rest, in the form that loses no digits where the slope is small.
        let root = (first * first + 2.0 * rest * (last - first) / piece.length).max(0.0);
        let since = 2.0 * rest / (first + root.sqrt()).max(f64::MIN_POSITIVE);
        piece.start + since.min(piece.length)
    }
}
