//! The shift of a region, with intervals from the scatter of its blocks.

use frame::Vectors;
use glam::{DMat2, DVec2};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::audit_self::block::Block;
use crate::audit_self::block_match::Shifted;
use crate::audit_self::fit::{Axes, Equations};
use crate::audit_self::frame_pair::FramePair;
use crate::statistics::{median, percentile};

/// Smallest number of blocks that have an interval.
const MIN_BLOCKS: usize = 4;
/// Blocks that differ more from the region's median belong to another motion, in pixels.
const SAME_MOTION: f64 = 1.0;
/// Largest number of steps of a fit.
const MAX_STEPS: usize = 6;
/// Probability above the interval, and below it.
const TAIL: f64 = 0.025;
/// Largest half width of a useful interval, in pixels.
pub const WIDEST: f64 = 0.25;
/// Factor on the standard error: without it, 88 % of planted errors were in their intervals, since
/// few blocks have most of the detail.
const WIDENED: f64 = 1.4;
/// Half width that an interval has at least: interpolation between pixels is off by as much.
const SYSTEMATIC: f64 = 0.01;

/// The error of a region's velocity: what it adds to the motion that the pictures show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Mean over the region, weighted by its detail, in pixels; +x right, +y down.
    pub bias: [f64; 2],
    /// Half widths of its 95 % confidence interval in x and y, in pixels.
    pub half_width: [f64; 2],
    /// Half width of the interval in the direction of the bias, in pixels.
    pub half_width_along: f64,
    /// Direction of the region's detail, if it is known in that direction alone.
    pub only_along: Option<[f64; 2]>,
    /// Median distance of single blocks from the bias, in pixels.
    pub spread: f64,
    /// 95 % confidence interval of the spread.
    pub spread_interval: [f64; 2],
    /// Number of blocks.
    pub blocks: usize,
}

impl Estimate {
    /// Fits one shift to the blocks of a region; none from too few blocks, or if no direction is
    /// known.
    pub fn of(pair: &FramePair, blocks: &[(&Block, Shifted)], velocity: &Vectors) -> Option<Self> {
        let middle = median_shift(blocks);
        let is_same = |shifted: &Shifted| shifted.fit.shift.distance(middle) <= SAME_MOTION;
        let same = blocks.iter().filter(|(_, shifted)| is_same(shifted));
        let same: Vec<&Block> = same.map(|(block, _)| *block).collect();
        let (bias, equations) = fit_together(pair, &same, velocity, middle)?;
        let axes = Axes::of(sum(&equations).matrix);
        let freedom = count_effective(&equations) - 1.0;
        if equations.len() < MIN_BLOCKS || freedom < 1.0 {
            return None;
        }
        let student = StudentsT::new(0.0, 1.0, freedom).expect("there are degrees of freedom");
        let quantile = student.inverse_cdf(1.0 - TAIL);
        let errors = jackknife(&equations, axes.is_one_way().then_some(axes.direction));
        let half = |direction: DVec2| {
            let variance = direction.dot(errors * direction).max(0.0);
            (WIDENED * quantile * variance.sqrt()).hypot(SYSTEMATIC)
        };
        let wide = Axes::of(errors).direction;
        let only_along = if axes.is_one_way() {
            Some(axes.direction)
        } else {
            (half(wide) > WIDEST).then_some(wide.perp())
        };
        let bias = only_along.map_or(bias, |along| along * along.dot(bias));
        let direction = only_along.unwrap_or(bias.normalize_or(DVec2::X));
        let half_width_along = half(direction);
        if half_width_along > WIDEST {
            return None;
        }
        let spread = Spread::of(blocks, bias, only_along);
        Some(Self {
            bias: bias.to_array(),
            half_width: match only_along {
                Some(along) => (along.abs() * half_width_along).to_array(),
                None => [half(DVec2::X), half(DVec2::Y)],
            },
            half_width_along,
            only_along: only_along.map(|along| along.to_array()),
            spread: spread.median,
            spread_interval: spread.interval,
            blocks: equations.len(),
        })
    }

    /// Returns the length of the bias.
    pub fn size(&self) -> f64 {
        DVec2::from(self.bias).length()
    }
}

/// Returns the median of the blocks' shifts, axis by axis.
pub fn median_shift(blocks: &[(&Block, Shifted)]) -> DVec2 {
    let shifts = || blocks.iter().map(|(_, shifted)| shifted.fit.shift);
    DVec2::new(
        median(shifts().map(|shift| shift.x)),
        median(shifts().map(|shift| shift.y)),
    )
}

/// Fits one shift to all blocks; also returns each block's equations there.
fn fit_together(
    pair: &FramePair,
    blocks: &[&Block],
    velocity: &Vectors,
    start: DVec2,
) -> Option<(DVec2, Vec<Equations>)> {
    let compare = |shift: DVec2| -> Vec<Equations> {
        let blocks = blocks.iter();
        blocks
            .filter_map(|block| Equations::at(pair, block, velocity, shift))
            .collect()
    };
    let mut shift = start;
    let mut equations = compare(shift);
    for _ in 0..MAX_STEPS {
        let step = sum(&equations).step();
        if !step.is_finite() || equations.is_empty() {
            return None;
        }
        shift += step.clamp_length_max(0.5);
        equations = compare(shift);
    }
    Some((shift, equations))
}

fn sum(equations: &[Equations]) -> Equations {
    let none = Equations {
        matrix: DMat2::ZERO,
        vector: DVec2::ZERO,
        correlation: 0.0,
        noise: 0.0,
        pixels: 0,
    };
    equations.iter().fold(none, |sum, block| Equations {
        matrix: sum.matrix + block.matrix,
        vector: sum.vector + block.vector,
        pixels: sum.pixels + block.pixels,
        ..sum
    })
}

/// Counts blocks by their detail: one with most of it counts for one, however many there are.
fn count_effective(equations: &[Equations]) -> f64 {
    let detail = |block: &Equations| Axes::of(block.matrix).most.max(0.0);
    let total: f64 = equations.iter().map(detail).sum();
    let squares: f64 = equations.iter().map(|block| detail(block).powi(2)).sum();
    total * total / squares.max(1e-30)
}

/// Computes the covariance of the shift by leaving out each block in turn; in one direction alone
/// if there is detail in no other.
fn jackknife(equations: &[Equations], only_along: Option<DVec2>) -> DMat2 {
    let all = sum(equations);
    let deviation = |block: &Equations| {
        let matrix = all.matrix - block.matrix;
        let vector = all.vector - block.vector;
        match only_along {
            Some(along) => along * (along.dot(vector) / along.dot(matrix * along)),
            None => matrix.inverse() * vector,
        }
    };
    let count = equations.len() as f64;
    let deviations: Vec<DVec2> = equations.iter().map(deviation).collect();
    let mean = deviations.iter().sum::<DVec2>() / count;
    let products = deviations.iter().map(|deviation| {
        let from_mean = *deviation - mean;
        DMat2::from_cols(from_mean * from_mean.x, from_mean * from_mean.y)
    });
    products.fold(DMat2::ZERO, |sum, product| sum + product) * ((count - 1.0) / count)
}

/// Distances of single blocks from the region's bias.
struct Spread {
    median: f64,
    interval: [f64; 2],
}

impl Spread {
    /// Measures it in the directions that each block has detail in.
    fn of(blocks: &[(&Block, Shifted)], bias: DVec2, only_along: Option<DVec2>) -> Self {
        let distance = |shifted: &Shifted| {
            let from_bias = shifted.fit.shift - bias;
            let axes = Axes::of(shifted.fit.equations.matrix);
            match only_along {
                Some(along) => along.dot(from_bias).abs(),
                None if axes.is_one_way() => axes.direction.dot(from_bias).abs(),
                None => from_bias.length(),
            }
        };
        let mut distances: Vec<f64> = blocks
            .iter()
            .map(|(_, shifted)| distance(shifted))
            .collect();
        distances.sort_by(f64::total_cmp);
        // Order statistics of a binomial with even odds.
        let half = 0.98 / (distances.len() as f64).sqrt();
        let part = |part: f64| percentile(&distances, part.clamp(0.0, 1.0)).unwrap_or(f64::NAN);
        Self {
            median: part(0.5),
            interval: [part(0.5 - half), part(0.5 + half)],
        }
    }
}
