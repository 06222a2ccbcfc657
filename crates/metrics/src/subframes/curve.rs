//! Curve of error against sub-frames, from the accumulation ladder.

use crate::{LadderRange, Subframes};

/// Curve of error against sub-frames: falling, positive, ready for interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Pairs (sub-frames, error), sub-frames rising and error strictly falling.
    points: Vec<(f64, f64)>,
}

impl Curve {
    /// Makes a curve through rungs in rising order of sub-frames.
    ///
    /// Noise can make a rung no better than one with fewer sub-frames. It is left out, so that the lowest of several counts
    /// with one error is reported. Noise can also make the unbiased error of a rung zero or less. That ends the curve: from
    /// there on the ladder cannot be distinguished from the truth. `None` if no rung is left.
    pub fn new(rungs: &[(u32, f64)]) -> Option<Self> {
        let mut points: Vec<(f64, f64)> = Vec::new();
        for &(subframes, error) in rungs {
            if error <= 0.0 {
                break;
            }
            if points.last().is_none_or(|(_, last)| error < *last) {
                points.push((f64::from(subframes), error));
            }
        }
        (!points.is_empty()).then_some(Self { points })
    }

    /// Converts an error and the noise in it to counts of sub-frames.
    pub fn convert(&self, error: f64, noise: f64) -> Subframes {
        let (value, range) = self.find_subframes(error);
        Subframes {
            value,
            floor: self.find_subframes(noise).0,
            range,
        }
    }

    /// Finds the count of sub-frames with this error: linear between rungs in the logarithms of both.
    pub fn find_subframes(&self, error: f64) -> (f64, LadderRange) {
        let first = self.points[0];
        let last = self.points[self.points.len() - 1];
        if error > first.1 {
            return (first.0, LadderRange::Below);
        }
        if error <= last.1 {
            return (last.0, LadderRange::Above);
        }
        let next = self
            .points
            .iter()
            .position(|point| point.1 <= error)
            .expect("an error above the last rung's has a rung not above it");
        let high = self.points[next];
        // A rung's own error is its own count; through logarithms it would be off by a rounding.
        if error == high.1 {
            return (high.0, LadderRange::Within);
        }
        let low = self.points[next - 1];
        let fraction = (low.1 / error).ln() / (low.1 / high.1).ln();
        let count = (low.0.ln() + fraction * (high.0 / low.0).ln()).exp();
        (count, LadderRange::Within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halving() -> Curve {
        let rungs: Vec<(u32, f64)> = [1, 2, 4, 8].map(|n| (n, 1.0 / f64::from(n))).to_vec();
        Curve::new(&rungs).expect("positive errors make a curve")
    }

    #[test]
    fn an_error_between_rungs_is_interpolated_in_logarithms() {
        let (count, range) = halving().find_subframes(1.0 / 3.0);
        // 1/N is a straight line in logarithms: rounding only.
        assert!((count - 3.0).abs() < 1e-12, "{count}");
        assert_eq!(range, LadderRange::Within);
    }

    #[test]
    fn a_rungs_own_error_is_its_own_count_and_the_last_rungs_the_end() {
        let curve = Curve::new(&[(1, 0.3), (2, 0.17), (4, 0.071), (16, 0.0123)]).expect("a curve");
        assert_eq!(curve.find_subframes(0.3), (1.0, LadderRange::Within));
        assert_eq!(curve.find_subframes(0.17), (2.0, LadderRange::Within));
        assert_eq!(curve.find_subframes(0.071), (4.0, LadderRange::Within));
        assert_eq!(curve.find_subframes(0.0123), (16.0, LadderRange::Above));
        let only = Curve::new(&[(4, 0.5)]).expect("a curve");
        assert_eq!(only.find_subframes(0.5), (4.0, LadderRange::Above));
    }

    #[test]
    fn a_rung_that_noise_made_no_better_is_left_out() {
        let curve = Curve::new(&[(1, 1.0), (2, 0.5), (4, 0.6), (8, 0.125)]).expect("a curve");
        let (count, _) = curve.find_subframes(0.25);
        // From (2, 1/2) straight to (8, 1/8).
        assert!((count - 4.0).abs() < 1e-12, "{count}");
    }

    #[test]
    fn a_ladder_ends_where_its_error_is_lost_in_noise() {
        let curve = Curve::new(&[(1, 1.0), (2, 0.5), (4, -0.01), (8, 0.1)]).expect("a curve");
        assert_eq!(curve.find_subframes(0.2), (2.0, LadderRange::Above));
        assert_eq!(Curve::new(&[(1, -1.0)]), None);
    }
}
