//! Cubic polynomials in time, and their interpolation between keys.

use std::ops::{Add, Mul, Sub};

use crate::model::Interpolation;

/// A number or a vector that changes along a curve.
pub trait Quantity:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl<T> Quantity for T where
    T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>
{
}

/// A cubic polynomial in the time since its start; coefficients from the lowest degree up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic<T>([T; 4]);

/// Upper limits of a curve within an interval.
pub struct CurveMaxima {
    /// Size of the value.
    pub value: f64,
    /// First derivative, per frame.
    pub slope: f64,
    /// Second derivative, per frame squared.
    pub bend: f64,
}

impl<T: Quantity> Cubic<T> {
    /// A curve of constant slope.
    pub fn line(value: T, slope: T) -> Self {
        Self([value, slope, T::default(), T::default()])
    }

    /// The curve with these values and slopes at its start and `duration` later (Hermite's form).
    pub fn between(values: [T; 2], slopes: [T; 2], duration: f64) -> Self {
        let chord = (values[1] - values[0]) * (1.0 / duration);
        let bend = (chord * 3.0 - slopes[0] * 2.0 - slopes[1]) * (1.0 / duration);
        let twist = (slopes[0] + slopes[1] - chord * 2.0) * (1.0 / (duration * duration));
        Self([values[0], slopes[0], bend, twist])
    }

    /// The value.
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

    /// Upper limits of the size of the curve and its derivatives within `[from, to]`; exact for a
    /// line. A curve with a second derivative of at most `d` strays from its chord by at most `d
    /// h^2 / 8`.
    pub fn maxima(&self, from: f64, to: f64, size: impl Fn(T) -> f64) -> CurveMaxima {
        let at_ends = |part: &dyn Fn(f64) -> T| size(part(from)).max(size(part(to)));
        let stray = (to - from) * (to - from) / 8.0;
        let bend = at_ends(&|time| self.bend(time));
        CurveMaxima {
            value: at_ends(&|time| self.at(time)) + bend * stray,
            slope: at_ends(&|time| self.slope(time)) + size(self.0[3] * 6.0) * stray,
            bend,
        }
    }

    /// The curve of a part of the value, such as one component of a vector.
    pub fn part<U>(&self, part: impl Fn(T) -> U) -> Cubic<U> {
        Cubic(self.0.map(part))
    }
}

impl<T: Quantity + PartialEq> Cubic<T> {
    /// Returns true if the curve never changes.
    pub fn is_constant(&self) -> bool {
        self.0[1..].iter().all(|part| *part == T::default())
    }
}

impl Cubic<f64> {
    /// Times at which the curve changes its direction, if any.
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

/// Keys at rising times, and the interpolation between them.
pub struct Keyed<'a, K> {
    pub keys: &'a [K],
    /// Time of a key, in frames.
    pub time: fn(&K) -> f64,
    pub interpolation: Interpolation,
}

impl<K> Keyed<'_, K> {
    /// The segment that `time` is in: 0 before the first key, `i` from key `i - 1` on.
    pub fn segment(&self, time: f64) -> usize {
        self.keys.partition_point(|key| (self.time)(key) <= time)
    }

    /// The segment just before `time`; at a key, the one that ends there.
    pub fn segment_before(&self, time: f64) -> usize {
        self.keys.partition_point(|key| (self.time)(key) < time)
    }

    /// The key that a segment's curves count their time from.
    pub fn anchor(&self, segment: usize) -> usize {
        segment.saturating_sub(1)
    }

    /// Returns true if a segment has a key at both ends.
    pub fn is_between(&self, segment: usize) -> bool {
        0 < segment && segment < self.keys.len()
    }

    /// The curve of a value over a segment, from its value at each key and its mean slope from each
    /// key to the next. Before the first key and after the last it is a line with the slope of that
    /// end.
    pub fn curve<T: Quantity>(
        &self,
        segment: usize,
        value: impl Fn(usize) -> T,
        chord: impl Fn(usize) -> T,
    ) -> Cubic<T> {
        let from = self.anchor(segment);
        if !self.is_between(segment) || self.interpolation == Interpolation::Linear {
            return Cubic::line(value(from), self.slope(from, &chord));
        }
        let slopes = [from, segment].map(|key| self.slope(key, &chord));
        Cubic::between([value(from), value(segment)], slopes, self.duration(from))
    }

    /// The slope at a key. If changes are linear, it is the slope of the segment after the key.
    /// Otherwise it is the slope of the parabola through the key and its neighbours, or at an end
    /// through the three nearest keys (Overhauser 1968; Catmull and Rom 1974, for uneven times).
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

    /// Time from a key to the next, in frames.
    pub fn duration(&self, key: usize) -> f64 {
        (self.time)(&self.keys[key + 1]) - (self.time)(&self.keys[key])
    }
}
