//! Polynomials in time, and the ones that lead through keys.

use std::ops::{Add, Mul, Sub};

use crate::motion::keys::Interpolation;

/// What can change along a curve: a number or a vector.
pub(crate) trait Quantity:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl<T> Quantity for T where
    T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>
{
}

/// A cubic polynomial in the time since its start, lowest degree first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cubic<T>([T; 4]);

/// Upper bounds on a curve within an interval.
pub(crate) struct Greatest {
    pub value: f64,
    /// Per frame.
    pub slope: f64,
    /// Second derivative, per frame squared.
    pub bend: f64,
}

impl<T: Quantity> Cubic<T> {
    /// Changes at a constant rate.
    pub fn line(value: T, slope: T) -> Self {
        Self([value, slope, T::default(), T::default()])
    }

    /// Has these values and slopes at its start and `duration` later (Hermite's form).
    pub fn between(values: [T; 2], slopes: [T; 2], duration: f64) -> Self {
        let chord = (values[1] - values[0]) * (1.0 / duration);
        let bend = (chord * 3.0 - slopes[0] * 2.0 - slopes[1]) * (1.0 / duration);
        let twist = (slopes[0] + slopes[1] - chord * 2.0) * (1.0 / (duration * duration));
        Self([values[0], slopes[0], bend, twist])
    }

    pub fn at(&self, time: f64) -> T {
        let [value, slope, bend, twist] = self.0;
        value + (slope + (bend + twist * time) * time) * time
    }

    /// First derivative.
    pub fn slope(&self, time: f64) -> T {
        let [_, slope, bend, twist] = self.0;
        slope + (bend * 2.0 + twist * (3.0 * time)) * time
    }

    /// Second derivative.
    fn bend(&self, time: f64) -> T {
        let [_, _, bend, twist] = self.0;
        bend * 2.0 + twist * (6.0 * time)
    }

    /// Bounds of the size of the curve and its derivatives within `[from, to]`; exact for a line. Whatever has a second
    /// derivative of at most `d` strays from its chord by at most `d h^2 / 8`.
    pub fn greatest(&self, from: f64, to: f64, size: impl Fn(T) -> f64) -> Greatest {
        let at_ends = |part: &dyn Fn(f64) -> T| size(part(from)).max(size(part(to)));
        let stray = (to - from) * (to - from) / 8.0;
        let bend = at_ends(&|time| self.bend(time));
        Greatest {
            value: at_ends(&|time| self.at(time)) + bend * stray,
            slope: at_ends(&|time| self.slope(time)) + size(self.0[3] * 6.0) * stray,
            bend,
        }
    }

    /// Part of a curve: one component of a vector.
    pub fn part<U>(&self, part: impl Fn(T) -> U) -> Cubic<U> {
        Cubic(self.0.map(part))
    }
}

impl<T: Quantity + PartialEq> Cubic<T> {
    /// Whether it never changes.
    pub fn is_constant(&self) -> bool {
        self.0[1..].iter().all(|part| *part == T::default())
    }
}

impl Cubic<f64> {
    /// Times at which the curve turns round, if any.
    pub fn turning_points(self) -> impl Iterator<Item = f64> {
        let [_, c, half_b, a] = self.0;
        // 3 a t^2 + 2 half_b t + c = 0, in the form that loses no digits to cancellation.
        let root = (half_b * half_b - 3.0 * a * c).sqrt();
        let sum = -(half_b + root.copysign(half_b));
        [sum / (3.0 * a), c / sum]
            .into_iter()
            .filter(|time| time.is_finite())
    }
}

/// Keys at rising times, and how values change between them.
pub(crate) struct Keyed<'a, K> {
    pub keys: &'a [K],
    /// Frames.
    pub time: fn(&K) -> f64,
    pub interpolation: Interpolation,
}

impl<K> Keyed<'_, K> {
    /// The stretch that `time` lies in: 0 before the first key, `i` from key `i - 1` on.
    pub fn stretch(&self, time: f64) -> usize {
        self.keys.partition_point(|key| (self.time)(key) <= time)
    }

    /// The key that a stretch's curves count their time from.
    pub fn anchor(&self, stretch: usize) -> usize {
        stretch.saturating_sub(1)
    }

    /// Whether a stretch has a key at both its ends.
    pub fn is_between(&self, stretch: usize) -> bool {
        0 < stretch && stretch < self.keys.len()
    }

    /// The curve of a value over a stretch, from its value at each key and its mean slope from each key to the next.
    /// Beyond the keys it is a line of the end's slope.
    pub fn curve<T: Quantity>(
        &self,
        stretch: usize,
        value: impl Fn(usize) -> T,
        chord: impl Fn(usize) -> T,
    ) -> Cubic<T> {
        let from = self.anchor(stretch);
        if !self.is_between(stretch) || self.interpolation == Interpolation::Linear {
            return Cubic::line(value(from), self.slope(from, &chord));
        }
        let slopes = [from, stretch].map(|key| self.slope(key, &chord));
        Cubic::between([value(from), value(stretch)], slopes, self.duration(from))
    }

    /// The slope at a key: of the stretch after it where changes are linear, otherwise of the parabola through the
    /// key and its neighbours, at an end that through the three keys nearest to it (Overhauser 1968; Catmull and Rom
    /// 1974, for uneven times).
    pub fn slope<T: Quantity>(&self, key: usize, chord: &impl Fn(usize) -> T) -> T {
        let Some(last) = self.keys.len().checked_sub(2) else {
            return T::default();
        };
        if self.interpolation == Interpolation::Linear || last == 0 {
            return chord(key.min(last));
        }
        let inside = |key: usize| {
            let [before, after] = [self.duration(key - 1), self.duration(key)];
            (chord(key - 1) * after + chord(key) * before) * (1.0 / (before + after))
        };
        match key {
            0 => chord(0) * 2.0 - inside(1),
            key if key > last => chord(last) * 2.0 - inside(last),
            key => inside(key),
        }
    }

    /// From a key to the next, in frames.
    pub fn duration(&self, key: usize) -> f64 {
        (self.time)(&self.keys[key + 1]) - (self.time)(&self.keys[key])
    }
}
