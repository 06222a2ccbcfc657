//! Curve of error against sub-frames, with the uncertainty of the error.

use super::LadderRange;

/// Halvings of the search for a count between two rungs: to a rounding.
const STEPS: u32 = 60;

/// Error at a number of sub-frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Number of sub-frames.
    pub subframes: f64,
    /// Estimate of the error; noise can make it negative.
    pub error: f64,
    /// Distance from the estimate to the lower end of its interval, not negative.
    pub below: f64,
    /// Distance to the upper end.
    pub above: f64,
}

/// Points in rising order of sub-frames, at least one. Noise can make an error rise from one to the
/// next.
///
/// Between two points, the logarithm of the error is linear in the logarithm of sub-frames, and so
/// is the uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve(pub Vec<Point>);

impl Curve {
    /// Finds the count of sub-frames with this error: the lowest of several; the curve's end if the
    /// error is beyond it.
    pub fn find(&self, error: f64) -> (f64, LadderRange) {
        let [first, last] = self.ends();
        if error > first.error {
            return (first.subframes, LadderRange::Below);
        }
        if let Some(at) = self.0.iter().position(|point| point.error <= error) {
            let is_end = at + 1 == self.0.len() && self.0[at].error == error;
            if at == 0 || is_end {
                return (self.0[at].subframes, LadderRange::Within);
            }
            let end = |point: &Point| point.error;
            return (self.cross(at - 1, error, end), LadderRange::Within);
        }
        (last.subframes, LadderRange::Above)
    }

    /// Finds the lowest count that may have this error; the last if all have more; none if it may
    /// be below the first.
    pub fn lowest(&self, error: f64) -> Option<f64> {
        let end = |point: &Point| point.error - point.below;
        match self.0.iter().position(|point| end(point) <= error) {
            None => Some(self.ends()[1].subframes),
            Some(0) => (end(&self.0[0]) == error).then_some(self.0[0].subframes),
            Some(at) => Some(self.cross(at - 1, error, end)),
        }
    }

    /// Finds the highest count that may have this error; the first if all have less; none if it may
    /// be above the last.
    pub fn highest(&self, error: f64) -> Option<f64> {
        let end = |point: &Point| point.error + point.above;
        match self.0.iter().rposition(|point| end(point) >= error) {
            None => Some(self.ends()[0].subframes),
            Some(at) if at + 1 == self.0.len() => {
                (end(&self.0[at]) == error).then_some(self.0[at].subframes)
            }
            Some(at) => Some(self.cross(at, error, end)),
        }
    }

    fn ends(&self) -> [Point; 2] {
        [self.0[0], self.0[self.0.len() - 1]]
    }

    /// Finds where an end of the error's interval falls to `error`, between a point and the next
    /// one.
    fn cross(&self, at: usize, error: f64, end: impl Fn(&Point) -> f64) -> f64 {
        let [a, b] = [self.0[at], self.0[at + 1]];
        // A rung's own error is its own count; the search would be off by a rounding.
        if end(&b) == error {
            return b.subframes;
        }
        let mut range = [0.0, 1.0];
        for _ in 0..STEPS {
            let middle = 0.5 * (range[0] + range[1]);
            let is_above = end(&interpolate(a, b, middle)) > error;
            range[usize::from(!is_above)] = middle;
        }
        interpolate(a, b, 0.5 * (range[0] + range[1])).subframes
    }
}

/// Interpolates two points, `part` of the way in the logarithm of sub-frames.
fn interpolate(a: Point, b: Point, part: f64) -> Point {
    let linear = |a: f64, b: f64| a + part * (b - a);
    // An error that is lost in noise has no logarithm: both are raised until it is as large as its
    // uncertainty.
    let raised = (b.below.max(b.above) - b.error).max(0.0);
    let [from, to] = [a, b].map(|point| point.error + raised);
    let error = if from > 0.0 && to > 0.0 {
        linear(from.ln(), to.ln()).exp() - raised
    } else {
        linear(a.error, b.error)
    };
    Point {
        subframes: linear(a.subframes.ln(), b.subframes.ln()).exp(),
        error,
        below: linear(a.below, b.below),
        above: linear(a.above, b.above),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(errors: &[(u32, f64)], uncertainty: f64) -> Curve {
        let points = errors.iter().map(|&(subframes, error)| Point {
            subframes: f64::from(subframes),
            error,
            below: uncertainty,
            above: uncertainty,
        });
        Curve(points.collect())
    }

    fn halving(uncertainty: f64) -> Curve {
        let errors = [1, 2, 4, 8].map(|n| (n, 1.0 / f64::from(n)));
        curve(&errors, uncertainty)
    }

    #[test]
    fn an_error_between_rungs_is_interpolated_in_logarithms() {
        let (count, range) = halving(0.0).find(1.0 / 3.0);
        // 1/N is a straight line in logarithms: rounding only.
        assert!((count - 3.0).abs() < 1e-12, "{count}");
        assert_eq!(range, LadderRange::Within);
    }

    #[test]
    fn a_rungs_own_error_is_its_own_count() {
        let curve = curve(&[(1, 0.3), (2, 0.17), (4, 0.071), (16, 0.0123)], 0.0);
        for (error, count) in [(0.3, 1.0), (0.17, 2.0), (0.071, 4.0), (0.0123, 16.0)] {
            assert_eq!(curve.find(error), (count, LadderRange::Within));
            assert_eq!(curve.lowest(error), Some(count));
            assert_eq!(curve.highest(error), Some(count));
        }
    }

    #[test]
    fn counts_beyond_the_ladder_have_an_open_end() {
        let ladder = halving(0.0);
        assert_eq!(ladder.find(1.1), (1.0, LadderRange::Below));
        assert_eq!((ladder.lowest(1.1), ladder.highest(1.1)), (None, Some(1.0)));
        assert_eq!(ladder.find(0.1), (8.0, LadderRange::Above));
        assert_eq!((ladder.lowest(0.1), ladder.highest(0.1)), (Some(8.0), None));
    }

    #[test]
    fn the_interval_of_a_count_holds_all_counts_whose_error_may_be_the_pictures() {
        // At 2.5 and at 10/3 sub-frames, an error of 0.4 - 0.0666 and 0.3 + 0.0333 is a third.
        let ends = |uncertainty: f64| {
            let ladder = halving(uncertainty);
            [ladder.lowest(1.0 / 3.0), ladder.highest(1.0 / 3.0)].map(Option::unwrap)
        };
        assert!((ends(0.4 - 1.0 / 3.0)[0] - 2.5).abs() < 1e-9);
        assert!((ends(1.0 / 30.0)[1] - 10.0 / 3.0).abs() < 1e-9);
        // More uncertainty than the last rung's distance leaves the upper end open, and then the
        // lower one.
        let uncertain = halving(0.25);
        assert_eq!(uncertain.highest(1.0 / 3.0), None);
        assert!(uncertain.lowest(1.0 / 3.0).is_some());
        assert_eq!(halving(0.7).lowest(1.0 / 3.0), None);
    }

    #[test]
    fn the_lowest_of_several_counts_is_the_count_and_the_interval_holds_the_others() {
        let ladder = curve(&[(1, 1.0), (2, 0.5), (4, 0.6), (8, 0.3), (16, 0.1)], 0.0);
        assert_eq!(ladder.find(0.5), (2.0, LadderRange::Within));
        assert_eq!(ladder.lowest(0.5), Some(2.0));
        let highest = ladder.highest(0.5).unwrap();
        assert!((4.0..8.0).contains(&highest), "{highest}");
    }

    #[test]
    fn an_error_lost_in_noise_leaves_its_count_open() {
        let ladder = curve(&[(1, 1.0), (2, 0.1), (4, -0.01), (8, 0.01)], 0.02);
        assert_eq!(ladder.highest(0.02), None);
        let (count, _) = ladder.find(0.05);
        let lowest = ladder.lowest(0.05).unwrap();
        assert!(
            (2.0..4.0).contains(&count) && lowest < count,
            "{count} {lowest}"
        );
    }
}
