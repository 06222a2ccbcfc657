//! The shift of each block: fitted from where velocity leads, or searched around it.

use frame::Vectors;
use glam::DVec2;

use crate::audit_self::block::{Block, MIN_PIXELS};
use crate::audit_self::fit::{Equations, Fit};
use crate::audit_self::frame_pair::{FramePair, Seen};

/// Smallest slope of a block's brightness that is detail: a step of 8 bits per pixel.
const LEAST_SLOPE: f64 = 1.0 / 255.0;
/// Smallest correlation of two pictures of one surface.
pub const LEAST_CORRELATION: f64 = 0.8;
/// Smallest correlation of a searched shift: the best of many is high by chance.
const LEAST_SEARCHED: f64 = 0.9;
/// Upper limit on the pixels that a search compares.
const SEARCHED_PIXELS: usize = 64;
/// Largest shift of a right block, in pixels.
const LARGEST_RIGHT: f64 = 0.25;
/// Largest ratio of what a shift leaves unexplained to what no shift leaves, if the shift is real.
const LEAST_GAIN: f64 = 0.6;

/// What the comparison of a block says.
pub enum Match {
    /// Nothing: too few of its pixels are visible in both frames.
    Unseen,
    /// Nothing: its brightness is even.
    Even,
    /// No shift makes both pictures alike.
    Unlike,
    /// The shift that makes them alike.
    Shift(Shifted),
}

/// The shift of a block, and its evidence.
#[derive(Clone, Copy, Debug)]
pub struct Shifted {
    pub fit: Fit,
    /// True if the pictures are not alike enough without the shift, and it is too large for a right
    /// velocity.
    pub is_off: bool,
}

/// Searches the shift of a block, at most `reach` pixels in each direction.
pub fn match_block(pair: &FramePair, block: &Block, velocity: &Vectors, reach: i32) -> Match {
    let start = Equations::at(pair, block, velocity, DVec2::ZERO);
    if !has_detail(pair, block) {
        return if start.is_some() { Match::Even } else { Match::Unseen };
    }
    let correlation = start.map(|start| start.correlation);
    let unexplained = 1.0 - correlation.unwrap_or(0.0);
    let is_alike = |fit: &Fit, least: f64| fit.equations.correlation >= least;
    let fitted = start.and_then(|_| Fit::from_start(pair, block, velocity, DVec2::ZERO));
    let fitted = fitted.filter(|fit| is_alike(fit, LEAST_CORRELATION));
    let searched = || {
        let place = search(pair, block, velocity, reach)?;
        let fit = Fit::from_start(pair, block, velocity, place)?;
        is_alike(&fit, LEAST_SEARCHED).then_some(fit)
    };
    match (fitted.or_else(searched), start) {
        (Some(fit), _) => {
            let left = 1.0 - fit.equations.correlation;
            Match::Shift(Shifted {
                fit,
                is_off: fit.shift.length() > LARGEST_RIGHT && left <= LEAST_GAIN * unexplained,
            })
        }
        (None, Some(_)) => Match::Unlike,
        (None, None) => Match::Unseen,
    }
}

/// Returns whether the later picture of a block has detail.
fn has_detail(pair: &FramePair, block: &Block) -> bool {
    let slopes = block.pixels.iter().filter_map(|at| pair.new_sample(*at));
    let slopes: Vec<DVec2> = slopes.map(|sample| sample.slope).collect();
    let count = slopes.len().max(1) as f64;
    let mean = slopes.iter().sum::<DVec2>() / count;
    let squares = slopes.iter().map(|slope| slope.distance_squared(mean));
    (squares.sum::<f64>() / count).sqrt() > LEAST_SLOPE
}

/// Finds the shift by whole pixels with the best correlation; none if the surface is nowhere.
fn search(pair: &FramePair, block: &Block, velocity: &Vectors, reach: i32) -> Option<DVec2> {
    let every = block.pixels.len().div_ceil(SEARCHED_PIXELS);
    let pixels: Vec<(usize, DVec2, f64)> = (block.pixels.iter().step_by(every))
        .filter_map(|at| {
            let place = pair.place(*at, velocity).round();
            Some((*at, place, pair.new_sample(*at)?.value))
        })
        .collect();
    let mut best = (LEAST_CORRELATION - 0.2, None);
    for y in -reach..=reach {
        for x in -reach..=reach {
            let shift = DVec2::new(f64::from(x), f64::from(y));
            let seen = pixels.iter().filter_map(|(at, place, new)| {
                let place = *place + shift;
                let is_same = pair.look(*at, place) == Seen::Same;
                let old = is_same.then(|| pair.old_sample(place)).flatten()?;
                Some([*new, old.value])
            });
            let correlation = correlate(seen, pixels.len());
            if correlation > best.0 {
                best = (correlation, Some(shift));
            }
        }
    }
    best.1
}

/// Correlates pairs of values; 0 if fewer than half of `all` are there.
fn correlate(pairs: impl Iterator<Item = [f64; 2]>, all: usize) -> f64 {
    let pairs: Vec<[f64; 2]> = pairs.collect();
    if pairs.len() < MIN_PIXELS.max(all.div_ceil(2)) {
        return 0.0;
    }
    let count = pairs.len() as f64;
    let means = [0, 1].map(|of| pairs.iter().map(|pair| pair[of]).sum::<f64>() / count);
    let sum = |a: usize, b: usize| {
        let products = pairs.iter();
        let products = products.map(|pair| (pair[a] - means[a]) * (pair[b] - means[b]));
        products.sum::<f64>()
    };
    sum(0, 1) / (sum(0, 0) * sum(1, 1)).sqrt().max(1e-12)
}
