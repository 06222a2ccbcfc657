//! Shifts of single blocks: fitted where velocity leads, or searched around that place.

use frame::Vectors;
use glam::DVec2;

use crate::audit_self::block::{Block, MIN_PIXELS};
use crate::audit_self::fit::{Equations, Fit, measure_detail};
use crate::audit_self::frame_pair::FramePair;

/// Smallest deviation of a block's brightness from a ramp that is detail: a step of 8 bits.
const LEAST_DETAIL: f64 = 1.0 / 255.0;
/// Smallest correlation of two pictures of one surface.
pub const LEAST_CORRELATION: f64 = 0.8;
/// Smallest correlation of a searched shift: the best of many is high by chance.
const LEAST_SEARCHED: f64 = 0.9;
/// Places closer to the best one than this are the same, in pixels.
const SAME_PLACE: f64 = 2.0;
/// Standard errors by which the best place must explain more than any other place: many are
/// compared.
const LEAST_LEAD: f64 = 4.0;
/// Upper limit on the pixels that a search compares.
const SEARCHED_PIXELS: usize = 64;
/// Largest shift of a right block, in pixels.
const LARGEST_RIGHT: f64 = 0.25;
/// Largest ratio of what a shift leaves unexplained to what no shift leaves, if the shift is real.
const LEAST_GAIN: f64 = 0.6;

/// Smallest number of standard errors of a real shift: many blocks are compared.
const LEAST_CERTAINTY: f64 = 5.0;

/// Result of the comparison of a block.
pub enum Match {
    /// None: too few of its pixels are visible in both frames.
    Unseen,
    /// None: its brightness is even.
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
        return if start.is_some() {
            Match::Even
        } else {
            Match::Unseen
        };
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
                is_off: fit.shift.length() > LARGEST_RIGHT
                    && left <= LEAST_GAIN * unexplained
                    && fit.certainty() >= LEAST_CERTAINTY,
            })
        }
        (None, Some(_)) => Match::Unlike,
        (None, None) => Match::Unseen,
    }
}

/// Returns whether the later picture of a block has detail.
pub fn has_detail(pair: &FramePair, block: &Block) -> bool {
    let samples = block.pixels.iter();
    let samples = samples.filter_map(|at| Some((pair.pixel(*at), pair.new_sample(*at)?.value)));
    let (places, values): (Vec<DVec2>, Vec<f64>) = samples.unzip();
    measure_detail(places, values.into_iter()) > LEAST_DETAIL
}

/// Finds the shift by whole pixels with the best correlation; none if the surface is nowhere, or at
/// several places.
fn search(pair: &FramePair, block: &Block, velocity: &Vectors, reach: i32) -> Option<DVec2> {
    let every = block.pixels.len().div_ceil(SEARCHED_PIXELS);
    let pixels: Vec<(usize, DVec2, f64)> = (block.pixels.iter().step_by(every))
        .filter_map(|at| {
            let place = pair.place(*at, velocity).round();
            Some((*at, place, pair.new_sample(*at)?.value))
        })
        .collect();
    let rows = -reach..=reach;
    let shifts = rows.flat_map(|y| (-reach..=reach).map(move |x| DVec2::new(x.into(), y.into())));
    let tried: Vec<(DVec2, f64)> = shifts
        .map(|shift| {
            let pairs = pixels
                .iter()
                .filter_map(|(at, place, new)| Some([*new, pair.old_value(*at, *place + shift)?]));
            (shift, correlate(pairs, pixels.len()))
        })
        .collect();
    let best = tried
        .iter()
        .max_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let others = tried
        .iter()
        .filter(|(shift, _)| shift.distance(best.0) > SAME_PLACE);
    let second = others
        .map(|(_, correlation)| *correlation)
        .fold(0.0, f64::max);
    let lead = ((1.0 - second) / (1.0 - best.1)).ln();
    let is_alone = lead >= LEAST_LEAD * lead_error(pixels.len());
    (best.1 >= LEAST_CORRELATION && is_alone).then_some(best.0)
}

/// The standard error of the logarithm of the ratio of two places' unexplained parts, each the
/// variance of so many differences.
fn lead_error(pixels: usize) -> f64 {
    2.0 / (pixels as f64).sqrt()
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
