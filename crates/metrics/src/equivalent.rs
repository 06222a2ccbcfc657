//! Equivalent sub-frames: the honest unit of a motion blur's error.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::Measured;

/// Number of accumulated sub-frames that have the picture's error, or the reason why none can be told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Equivalent {
    /// The picture is as good as the mean of that many sub-frames.
    Subframes(Subframes),
    /// No count.
    NotApplicable {
        /// Why.
        #[serde(rename = "not_applicable")]
        reason: String,
    },
}

/// A count of sub-frames between the ladder's ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subframes {
    /// The count, not an integer as a rule; the end of the ladder where the error lies beyond it.
    pub value: f64,
    /// The highest count that the truth's own noise lets be told.
    pub floor: f64,
    /// Whether the error lies beyond an end of the ladder.
    pub reach: Reach,
}

/// Position of an error relative to a ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reach {
    /// Worse than the first rung: `<1`.
    Below,
    /// Between the first rung and the last.
    Within,
    /// No worse than the last: `>64`.
    Above,
}

/// Error against sub-frames: falling, positive, ready for interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// (sub-frames, error), sub-frames rising and error strictly falling.
    points: Vec<(f64, f64)>,
}

impl Equivalent {
    /// No count, because of `reason`.
    pub(crate) fn refused(reason: &str) -> Self {
        Self::NotApplicable {
            reason: reason.to_owned(),
        }
    }

    /// Converts the count to a score.
    pub fn measured(&self) -> Measured {
        match self {
            Equivalent::Subframes(subframes) => Measured::score(subframes.value, subframes.floor),
            Equivalent::NotApplicable { reason } => Measured::not_applicable(reason),
        }
    }
}

impl fmt::Display for Equivalent {
    /// `<1`, `3.7`, `>64`, or `n/a`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Equivalent::Subframes(subframes) => match subframes.reach {
                Reach::Below => format!("<{}", subframes.value),
                Reach::Within => format!("{:.1}", subframes.value),
                Reach::Above => format!(">{}", subframes.value),
            },
            Equivalent::NotApplicable { .. } => "n/a".to_owned(),
        };
        f.pad(&text)
    }
}

impl Curve {
    /// A curve through rungs in rising order of sub-frames.
    ///
    /// Noise can make a rung no better than one with fewer sub-frames, or (an unbiased error) no worse than perfect. The
    /// first is left out: where several counts have one error, the lowest is reported. The second ends the curve: from
    /// there on the ladder cannot be told from the truth. `None` when no rung is left.
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

    /// An error, and the noise in it, as counts of sub-frames.
    pub fn place(&self, error: f64, noise: f64) -> Subframes {
        let (value, reach) = self.subframes(error);
        Subframes {
            value,
            floor: self.subframes(noise).0,
            reach,
        }
    }

    /// The count of sub-frames with this error: linear between rungs in the logarithms of both.
    pub fn subframes(&self, error: f64) -> (f64, Reach) {
        let first = self.points[0];
        let last = self.points[self.points.len() - 1];
        if error > first.1 {
            return (first.0, Reach::Below);
        }
        if error <= last.1 {
            return (last.0, Reach::Above);
        }
        let next = self
            .points
            .iter()
            .position(|point| point.1 <= error)
            .expect("an error above the last rung's has a rung not above it");
        let high = self.points[next];
        // A rung's own error is its own count; through logarithms it would be off by a rounding.
        if error == high.1 {
            return (high.0, Reach::Within);
        }
        let low = self.points[next - 1];
        let fraction = (low.1 / error).ln() / (low.1 / high.1).ln();
        let count = (low.0.ln() + fraction * (high.0 / low.0).ln()).exp();
        (count, Reach::Within)
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
        let (count, reach) = halving().subframes(1.0 / 3.0);
        // 1/N is a straight line in logarithms: rounding only.
        assert!((count - 3.0).abs() < 1e-12, "{count}");
        assert_eq!(reach, Reach::Within);
    }

    #[test]
    fn errors_beyond_the_ends_say_so() {
        assert_eq!(halving().subframes(1.1), (1.0, Reach::Below));
        assert_eq!(halving().subframes(0.1), (8.0, Reach::Above));
        assert_eq!(halving().subframes(-0.1), (8.0, Reach::Above));
        assert_eq!(halving().subframes(1.0), (1.0, Reach::Within));
    }

    #[test]
    fn a_rungs_own_error_is_its_own_count_and_the_last_rungs_the_end() {
        let curve = Curve::new(&[(1, 0.3), (2, 0.17), (4, 0.071), (16, 0.0123)]).expect("a curve");
        assert_eq!(curve.subframes(0.17), (2.0, Reach::Within));
        assert_eq!(curve.subframes(0.071), (4.0, Reach::Within));
        assert_eq!(curve.subframes(0.0123), (16.0, Reach::Above));
        let only = Curve::new(&[(4, 0.5)]).expect("a curve");
        assert_eq!(only.subframes(0.5), (4.0, Reach::Above));
    }

    #[test]
    fn a_rung_that_noise_made_no_better_is_left_out() {
        let curve = Curve::new(&[(1, 1.0), (2, 0.5), (4, 0.6), (8, 0.125)]).expect("a curve");
        let (count, _) = curve.subframes(0.25);
        // From (2, 1/2) straight to (8, 1/8).
        assert!((count - 4.0).abs() < 1e-12, "{count}");
    }

    #[test]
    fn a_ladder_ends_where_its_error_is_lost_in_noise() {
        let curve = Curve::new(&[(1, 1.0), (2, 0.5), (4, -0.01), (8, 0.1)]).expect("a curve");
        assert_eq!(curve.subframes(0.2), (2.0, Reach::Above));
        assert_eq!(Curve::new(&[(1, -1.0)]), None);
    }

    #[test]
    fn counts_print_as_people_say_them() {
        let print = |value, reach| {
            Equivalent::Subframes(Subframes {
                value,
                floor: 64.0,
                reach,
            })
            .to_string()
        };
        assert_eq!(print(1.0, Reach::Below), "<1");
        assert_eq!(print(3.74, Reach::Within), "3.7");
        assert_eq!(print(64.0, Reach::Above), ">64");
    }
}
