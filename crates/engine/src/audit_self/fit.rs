//! Fit of a shift between both pictures of a block.

use frame::Vectors;
use glam::{DMat2, DVec2};

use crate::audit_self::block::{Block, MIN_PIXELS};
use crate::audit_self::brightness::Sample;
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
/// Pixels for which one counts: smoothing makes neighbours share their noise.
const SHARED_NOISE: f64 = 4.0;
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
    /// Mean square of the residual.
    pub noise: f64,
    /// Pixels compared.
    pub pixels: usize,
}

/// A pixel in both pictures.
struct Pair {
    place: DVec2,
    new: Sample,
    old: Sample,
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
            Some(Pair {
                place: pair.pixel(*at),
                new: pair.new_sample(*at)?,
                old: pair.old_sample(place)?,
            })
        });
        let samples: Vec<Pair> = samples.collect();
        (samples.len() >= MIN_PIXELS).then(|| Self::solve(&samples))
    }

    fn solve(samples: &[Pair]) -> Self {
        let ramps = Ramps::at(samples.iter().map(|pair| pair.place).collect());
        // Smooth light is not attached to a surface, and its ramp would be taken for detail.
        let values = |value: &dyn Fn(&Pair) -> f64| ramps.subtract(samples.iter().map(value));
        let [new, old] = [
            values(&|pair| pair.new.value),
            values(&|pair| pair.old.value),
        ];
        let [slope_x, slope_y] = [
            values(&|pair| pair.new.slope.x),
            values(&|pair| pair.new.slope.y),
        ];
        let square = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
        let [new_square, old_square] = [square(&new), square(&old)].map(|square| square.max(1e-12));
        let product: f64 = std::iter::zip(&new, &old).map(|(new, old)| new * old).sum();
        // Light may change between the frames.
        let gain = (new_square / old_square).sqrt().clamp(0.5, 2.0);
        let residuals: Vec<f64> = std::iter::zip(&new, &old)
            .map(|(new, old)| new - gain * old)
            .collect();
        let deviation = 1.4826 * median(residuals.iter().map(|residual| residual.abs()));
        let limit = (OUTLIER * deviation).max(1e-6);
        let mut equations = Self {
            matrix: DMat2::ZERO,
            vector: DVec2::ZERO,
            noise: 0.0,
            correlation: product / (new_square * old_square).sqrt(),
            pixels: samples.len(),
        };
        let mut total = 0.0;
        for (at, residual) in residuals.into_iter().enumerate() {
            let weight = 1.0 / (1.0 + (residual / limit).powi(2));
            let slope = weight * DVec2::new(slope_x[at], slope_y[at]);
            let old_slope = gain * samples[at].old.slope;
            equations.matrix += DMat2::from_cols(slope * old_slope.x, slope * old_slope.y);
            equations.vector += slope * residual;
            equations.noise += weight * residual * residual;
            total += weight;
        }
        equations.noise /= total;
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

/// Linear functions of the place in a block.
struct Ramps {
    /// Places relative to their mean.
    places: Vec<DVec2>,
    /// Inverse of the sum of their products.
    inverse: DMat2,
}

impl Ramps {
    fn at(mut places: Vec<DVec2>) -> Self {
        let mean = places.iter().sum::<DVec2>() / places.len() as f64;
        let mut products = DMat2::from_diagonal(DVec2::splat(1e-9));
        for place in &mut places {
            *place -= mean;
            products += DMat2::from_cols(*place * place.x, *place * place.y);
        }
        Self {
            places,
            inverse: products.inverse(),
        }
    }

    /// Subtracts the mean and the ramp that fit some values best.
    fn subtract(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut values: Vec<f64> = values.collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let products = std::iter::zip(&self.places, &values);
        let products = products.map(|(place, value)| place * (value - mean));
        let slope = self.inverse * products.sum::<DVec2>();
        for (place, value) in std::iter::zip(&self.places, &mut values) {
            *value -= mean + slope.dot(*place);
        }
        values
    }
}

/// Returns how much some values differ from the best linear function of their places: the root of
/// their mean square.
pub fn measure_detail(places: Vec<DVec2>, values: impl Iterator<Item = f64>) -> f64 {
    let count = places.len().max(1) as f64;
    let left = Ramps::at(places).subtract(values);
    (left.iter().map(|value| value * value).sum::<f64>() / count).sqrt()
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
    /// Returns how many standard errors of the block's own noise the shift is long.
    pub fn certainty(&self) -> f64 {
        let Equations { matrix, noise, .. } = self.equations;
        let square = self.shift.dot(matrix * self.shift).max(0.0);
        (square / (SHARED_NOISE * noise).max(1e-12)).sqrt()
    }

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
