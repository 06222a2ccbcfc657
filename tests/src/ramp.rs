//! A blur's ramp of an edge.

/// Change from one side of an edge to the other, along the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Length in pixels of the even ramp with the same spread.
    pub length: f64,
    /// Position of its middle, in pixels; negative against the motion.
    pub middle: f64,
}

impl Ramp {
    /// Measures an edge from (position, brightness) at rising positions, in pixels. Slopes count
    /// with their sign, so that noise cancels.
    pub fn of(profile: &[(f64, f64)]) -> Self {
        let slope = |pair: &[(f64, f64)]| (0.5 * (pair[0].0 + pair[1].0), pair[1].1 - pair[0].1);
        Self::spread(profile.windows(2).map(slope).collect::<Vec<_>>())
    }

    /// Makes the ramp of offsets in pixels, each with its weight.
    pub fn spread(weighed: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (mut total, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (offset, weight) in weighed {
            total += weight;
            sum += weight * offset;
            squares += weight * offset * offset;
        }
        assert!(total != 0.0, "there is no edge to measure");
        let middle = sum / total;
        let variance: f64 = squares / total - middle * middle;
        Self {
            // An even ramp of length L has the variance L^2 / 12. Rounding may leave less than
            // zero.
            length: (12.0 * variance.max(0.0)).sqrt(),
            middle,
        }
    }

    /// Removes the softness that the edge had before the blur: variances add.
    pub fn beyond(self, before: Self) -> Self {
        let squares = self.length * self.length - before.length * before.length;
        Self {
            length: squares.max(0.0).sqrt(),
            middle: self.middle - before.middle,
        }
    }
}
