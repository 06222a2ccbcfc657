//! Fit of a shift between both pictures of a block.

use frame::Vectors;
use glam::{DMat2, DVec2};

use crate::audit_self::block::{Block, MIN_PIXELS};
use crate::audit_self::frame_pair::{FramePair, Seen};
use crate::statistics::median;

/// Largest number of steps of a fit.
const MAX_STEPS: usize = 12;
/// Step at which a fit ends, in pixels.
const SMALL_STEP: f64 = 1e-3;
/// Largest distance of a fitted shift from its start, in pixels.
const REACH: f64 = 2.0;
/// Smallest ratio of a block's detail in its weak direction to that in its strong one, from which
/// on it has detail in both.
const LEAST_RATIO: f64 = 0.05;
/// Residuals beyond this many standard deviations lose weight.
const OUTLIER: f64 = 2.4;

/// The comparison of a block's pixels at a shift, as the step to a better one: `step` solves
/// `matrix * step = vector`.
///
/// The slopes of the later picture are multiplied by the residual and by the slopes of the earlier
/// one. Noise of the two is independent, so that it neither shortens nor lengthens the step, which
/// least squares with one picture's slopes would.
#[derive(Clone, Copy, Debug)]
pub struct Equations {
    pub matrix: DMat2,
    pub vector: DVec2,
    /// Correlation of both pictures.
    pub correlation: f64,
    /// Pixels compared.
    pub pixels: usize,
}

/// A pixel in both pictures.
struct Pair {
    new: f64,
    old: f64,
    new_slope: DVec2,
    old_slope: DVec2,
}

impl Equations {
    /// Compares a block at the places that velocity leads to, each moved by a shift; none if fewer
    /// pixels than a block needs show the same surface.
    pub fn at(pair: &FramePair, block: &Block, velocity: &Vectors, shift: DVec2) -> Option<Self> {
        let samples = block.pixels.iter().filter_map(|at| {
            let place = pair.place(*at, velocity) + shift;
            if pair.look(*at, place) != Seen::Same {
                return None;
            }
            let (new, old) = (pair.new_sample(*at)?, pair.old_sample(place)?);
            Some(Pair {
                new: new.value,
                old: old.value,
                new_slope: new.slope,
                old_slope: old.slope,
            })
        });
        let samples: Vec<Pair> = samples.collect();
        (samples.len() >= MIN_PIXELS).then(|| Self::solve(&samples))
    }

    fn solve(samples: &[Pair]) -> Self {
        let new = Moments::of(samples.iter().map(|pair| pair.new));
        let old = Moments::of(samples.iter().map(|pair| pair.old));
        let products = samples.iter();
        let products = products.map(|pair| (pair.new - new.mean) * (pair.old - old.mean));
        let covariance = products.sum::<f64>() / samples.len() as f64;
        // Light may change between the frames.
        let gain = new.deviation / old.deviation.max(1e-9);
        let gain = gain.clamp(0.5, 2.0);
        let residual = |pair: &Pair| (pair.new - new.mean) - gain * (pair.old - old.mean);
        let deviation = 1.4826 * median(samples.iter().map(|pair| residual(pair).abs()));
        let limit = (OUTLIER * deviation).max(1e-6);
        let weight = |pair: &Pair| 1.0 / (1.0 + (residual(pair) / limit).powi(2));
        let total: f64 = samples.iter().map(weight).sum();
        let mean = |slope: &dyn Fn(&Pair) -> DVec2| {
            let slopes = samples.iter().map(|pair| weight(pair) * slope(pair));
            slopes.sum::<DVec2>() / total
        };
        let [new_mean, old_mean] = [mean(&|pair| pair.new_slope), mean(&|pair| pair.old_slope)];
        let mut equations = Self {
            matrix: DMat2::ZERO,
            vector: DVec2::ZERO,
            correlation: covariance / (new.deviation * old.deviation).max(1e-12),
            pixels: samples.len(),
        };
        for pair in samples {
            let slope = weight(pair) * (pair.new_slope - new_mean);
            let old_slope = gain * (pair.old_slope - old_mean);
            equations.matrix += DMat2::from_cols(slope * old_slope.x, slope * old_slope.y);
            equations.vector += slope * residual(pair);
        }
        equations
    }

    /// Solves for the step, only in the direction of most detail if there is little across it.
    pub fn step(&self) -> DVec2 {
        let strong = Axes::of(self.matrix);
        if strong.is_one_way() {
            strong.direction * (strong.direction.dot(self.vector) / strong.most.max(1e-12))
        } else {
            self.matrix.inverse() * self.vector
        }
    }
}

/// Mean and standard deviation of some values.
struct Moments {
    mean: f64,
    deviation: f64,
}

impl Moments {
    fn of(values: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let count = values.len() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let squares = values.map(|value| (value - mean).powi(2)).sum::<f64>();
        Self {
            mean,
            deviation: (squares / count).sqrt(),
        }
    }
}

/// Axes of a matrix's symmetric part.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Direction of the larger value.
    pub direction: DVec2,
    pub most: f64,
    pub least: f64,
}

impl Axes {
    pub fn of(matrix: DMat2) -> Self {
        let (xx, yy) = (matrix.x_axis.x, matrix.y_axis.y);
        let xy = 0.5 * (matrix.x_axis.y + matrix.y_axis.x);
        let [middle, half] = [0.5 * (xx + yy), 0.5 * (xx - yy)];
        let radius = half.hypot(xy);
        let angle = 0.5 * xy.atan2(half);
        Self {
            direction: DVec2::from_angle(angle),
            most: middle + radius,
            least: middle - radius,
        }
    }

    /// Returns whether there is little across the direction.
    pub fn is_one_way(&self) -> bool {
        self.least < LEAST_RATIO * self.most
    }
}

/// The shift that fits a block best, and its comparison there.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// Added to the place that velocity leads to, in pixels: velocity is wrong by as much.
    pub shift: DVec2,
    pub equations: Equations,
}

impl Fit {
    /// Fits a block's shift, from a start; none if that leads too far away.
    pub fn from_start(
        pair: &FramePair,
        block: &Block,
        velocity: &Vectors,
        start: DVec2,
    ) -> Option<Self> {
        let mut shift = start;
        let mut equations = Equations::at(pair, block, velocity, shift)?;
        for _ in 0..MAX_STEPS {
            let step = equations.step();
            shift += step.clamp_length_max(1.0);
            if !shift.is_finite() || shift.distance(start) > REACH {
                return None;
            }
            equations = Equations::at(pair, block, velocity, shift)?;
            if step.length() < SMALL_STEP {
                break;
            }
        }
        Some(Self { shift, equations })
    }
}
