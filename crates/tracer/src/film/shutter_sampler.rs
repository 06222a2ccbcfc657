//! Times within a shutter interval, in proportion to the shutter's efficiency.

use frame::{Shutter, ShutterProfile};

/// Draws times from a shutter by its cumulative efficiency.
#[derive(Clone, Debug)]
pub(crate) struct ShutterSampler {
    /// Length of the interval, in frames.
    exposure: f64,
    /// Part of the interval before the instant.
    before: f64,
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
        let exposure = shutter.exposure();
        Self {
            exposure,
            before: -shutter.open / exposure,
            profile: profile.clone(),
            pieces,
            total,
        }
    }

    /// The time of a sample, in frames, from a number in [0, 1).
    ///
    /// The numbers rise with time, with a period of one exposure, and are 0 where a trailing
    /// shutter opens. So two alignments of one exposure without ramps have equal times wherever
    /// they overlap, bit for bit, and share their samples there. Every alignment has each part of
    /// its interval once, and is stratified as well as any other.
    pub fn sample_time(&self, number: f64, row: u32, height: u32) -> f64 {
        self.time(self.sample_part(number), row, height)
    }

    /// The time of that sample's sub-frame. Sub-frames are `subframes` equal parts of the light;
    /// this is the middle of the part that has [`ShutterSampler::sample_time`].
    pub fn subframe_time(&self, number: f64, subframes: u32, row: u32, height: u32) -> f64 {
        let subframes = f64::from(subframes);
        let index = (self.sample_part(number) * subframes).floor();
        self.time((index + 0.5) / subframes, row, height)
    }

    /// The part of all light that has passed by the time of a sample.
    fn sample_part(&self, number: f64) -> f64 {
        let opening = (1.0 - self.before).clamp(0.0, 1.0);
        if number < opening {
            number + (1.0 - opening)
        } else {
            number - opening
        }
    }

    /// The time, in frames, by which `part` of all light of a row has passed; `part` is in [0, 1).
    fn time(&self, part: f64, row: u32, height: u32) -> f64 {
        let since_opening = self.place(part * self.total);
        self.exposure * (since_opening - self.before) + self.profile.row_offset(row, height)
    }

    /// The part of the interval after which the efficiency's integral is `sum`.
    fn place(&self, sum: f64) -> f64 {
        let index = self.pieces.partition_point(|piece| piece.until <= sum);
        // Rounding may lead past the last piece.
        let piece = self.pieces[index.min(self.pieces.len() - 1)];
        let [first, last] = piece.efficiencies;
        let before = piece.until - 0.5 * (first + last) * piece.length;
        let rest = (sum - before).max(0.0);
        if first == last {
            let since = rest / first.max(f64::MIN_POSITIVE);
            return piece.start + since.min(piece.length);
        }
        // first s + (last - first) s^2 / (2 length) = rest, in the form that loses no digits where
        // the slope is small.
        let root = (first * first + 2.0 * rest * (last - first) / piece.length).max(0.0);
        let since = 2.0 * rest / (first + root.sqrt()).max(f64::MIN_POSITIVE);
        piece.start + since.min(piece.length)
    }
}

#[cfg(test)]
mod tests {
    use frame::Alignment;

    use super::*;

    #[test]
    fn sub_frames_lie_at_the_middles_of_equal_parts_of_the_interval_that_have_the_samples() {
        for alignment in Alignment::ALL {
            let shutter = alignment.shutter(0.5).expect("it is allowed");
            let sampler = ShutterSampler::new(shutter, &ShutterProfile::default());
            for number in (0..64).map(|step| (f64::from(step) + 0.5) / 64.0) {
                let time = sampler.sample_time(number, 3, 9);
                for subframes in [1, 4, 64] {
                    let part = 0.5 / f64::from(subframes);
                    let index = ((time - shutter.open) / part).floor();
                    let middle = shutter.open + (index + 0.5) * part;
                    let subframe_time = sampler.subframe_time(number, subframes, 3, 9);
                    assert!(
                        (subframe_time - middle).abs() < 1e-12,
                        "{subframe_time} {middle}"
                    );
                }
            }
        }
    }

    #[test]
    fn alignments_share_the_times_of_their_overlap_bit_for_bit() {
        for exposure in [0.5, 0.3, 0.7123] {
            let [trailing, centred, leading] = Alignment::ALL.map(|alignment| {
                let shutter = alignment.shutter(exposure).expect("it is allowed");
                (
                    shutter,
                    ShutterSampler::new(shutter, &ShutterProfile::default()),
                )
            });
            for step in 0..1000 {
                // The sampler's numbers have 24 bits, and sums of them are exact.
                let number = f64::from(step as f32 / 1000.0);
                let times = [&trailing, &centred, &leading].map(|(shutter, sampler)| {
                    let time = sampler.sample_time(number, 3, 9);
                    assert!((shutter.open..shutter.close).contains(&time), "{time}");
                    time
                });
                if number < 0.5 {
                    assert_eq!(times[1], times[2]);
                } else {
                    assert_eq!(times[0], times[1]);
                }
            }
        }
    }
}
