//! Length, side and direction of a smear: the shutter whose even smear fits a picture best.

mod verdict;

use std::iter::Sum;

use frame::{Frame, Image, Size};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::object::mover::{Displacement, moving_pixels};

/// Least motion over the exposure, in pixels: a shorter smear has no length to measure.
const LEAST_MOTION: f64 = 2.0;
/// Least pixels of a mover.
const LEAST_PIXELS: usize = 60;
/// Most pixels of a mover that are compared.
const MOST_PIXELS: usize = 3000;
/// How far from the instant shutters are searched, in exposures: a double exposure and a reserve.
const REACH: f64 = 2.5;
/// Steps per exposure that the search starts with, and finer ones around the best.
const COARSE: usize = 8;
const FINE: usize = 64;
/// Steps from the instant to the end of the search.
const HALF: usize = (REACH * FINE as f64) as usize;
/// Steps of a centred exposure.
const EXPOSURE: Steps = [HALF - FINE / 2, HALF + FINE / 2];
/// Change of a picture, in parts of its colours, that may be rounding: half floats are off by up to
/// 0.0005.
const ROUNDING: f64 = 1e-3;
/// Part of the error of the best smear along the motion that one in another direction must stay
/// below: a real one leaves a small part.
const CLEARLY_BETTER: f64 = 0.5;

/// Direction of a smear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SmearDirection {
    /// Along the motion.
    Along,
    /// Along the motion with up and down exchanged.
    Flipped,
    /// At a right angle to it.
    Across,
}

/// The even smear that fits a picture of a mover best.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Smear {
    /// Motion over the exposure, in pixels.
    pub motion: f64,
    /// Direction.
    pub direction: SmearDirection,
    /// When its shutter opens, in exposures after the instant: -1 for a trailing one, -0.5 for a
    /// centred one.
    pub open: f64,
    /// When it closes: 0 for a trailing one, 0.5 for a centred one.
    pub close: f64,
    /// Weight of the even smear; the rest is the frame's own colour, which many filters count more
    /// than once.
    pub weight: f64,
    /// Difference of the picture from that sum, as a part of its difference from no blur: 0 for a
    /// perfect fit, 1 if nothing is gained.
    pub rest: f64,
}

/// A ray of colours through a pixel, as sums from its start on.
struct Ray {
    /// Colour of the frame at the pixel.
    frame: [f64; 3],
    /// Change of the picture from it.
    change: [f64; 3],
    /// Sums of the frame's colours up to each step.
    sums: Vec<[f64; 3]>,
}

/// An interval of steps along a ray.
type Steps = [usize; 2];

/// Measures the smear of the only object that moves, in a picture that was made from the frame,
/// which has no guard band.
///
/// On the mover an even smear is the mean of the frame's colours along the motion, whatever a
/// filter does beyond the silhouette. The smear is the interval and its weight, next to the frame's
/// own colour, that leave the least squared difference.
/// None if the camera or several objects move, if the object does not translate or touches the
/// border, if its motion is too short, or if neither the picture nor an even smear differs from the
/// frame: a mover of one colour shows no smear.
pub fn measure_smear(frame: &Frame, picture: &Image) -> Option<Smear> {
    let (displacement, shown) = only_mover(frame)?;
    let motion = displacement[0].hypot(displacement[1]);
    let pixels = pick_pixels(frame.color.size(), &shown, REACH * motion)?;
    let [x, y] = displacement.map(|part| part / motion);
    let trace = |along: [f64; 2]| {
        let step = along.map(|part| part * motion);
        let rays = (pixels.par_iter()).map(|at| trace_ray(frame, picture, *at, step));
        rays.collect::<Vec<Ray>>()
    };
    let rays = trace([x, y]);
    let colors: f64 = rays.iter().map(|ray| square(&ray.frame)).sum();
    let rounding = ROUNDING * ROUNDING * colors;
    if rays.iter().map(Ray::change).sum::<f64>() <= rounding {
        let even = rays.iter().map(|ray| ray.products(EXPOSURE).smears);
        return (even.sum::<f64>() > rounding).then(|| Smear::nothing(motion));
    }
    let nothing = Smear::nothing(motion);
    let mut best = fit(&rays, nothing)?;
    let mut ways = vec![(SmearDirection::Across, [-y, x])];
    // Level and plumb motion does not change its line.
    if x.abs().min(y.abs()) > 0.1 {
        ways.push((SmearDirection::Flipped, [x, -y]));
    }
    for (direction, along) in ways {
        let other = fit(
            &trace(along),
            Smear {
                direction,
                ..nothing
            },
        )?;
        if other.0 < CLEARLY_BETTER * best.0 {
            best = other;
        }
    }
    Some(best.1)
}

/// Finds the displacement of the only object that moves over the exposure, and the indices of its
/// pixels. Without names of objects, all that moves is one. None if several move, or if that one
/// does not translate, as scores of objects decide it.
fn only_mover(frame: &Frame) -> Option<([f64; 2], Vec<usize>)> {
    let ids = 0..frame.objects.len() as u32;
    let mut movers = ids.filter_map(|id| Some((id, Displacement::new(frame, id).ok()?)));
    let has_names = frame.objects.len() > 1;
    let (motion, is_shown): (Displacement, Vec<bool>) = if has_names {
        let (id, motion) = movers.next()?;
        if id == 0 || movers.next().is_some() {
            return None;
        }
        let ids = frame.object_id.pixels.iter();
        (motion, ids.map(|shown| *shown == id).collect())
    } else {
        (Displacement::of_all(frame)?, moving_pixels(frame).collect())
    };
    let [x, y] = motion.mean;
    let shown = (0..is_shown.len()).filter(|index| is_shown[*index]);
    (motion.is_translation() && x.hypot(y) >= LEAST_MOTION).then(|| (motion.mean, shown.collect()))
}

/// Picks pixels of the mover, evenly over its area; none if it has too few, or if a smear of `reach`
/// pixels would leave the picture.
fn pick_pixels(size: Size, shown: &[usize], reach: f64) -> Option<Vec<(u32, u32)>> {
    let at = |index: &usize| (*index as u32 % size.width, *index as u32 / size.width);
    let is_inside = |(x, y): &(u32, u32)| {
        let (right, bottom) = (size.width - 1 - x, size.height - 1 - y);
        f64::from(*x.min(y).min(&right).min(&bottom)) > reach.min(f64::from(size.height) / 3.0)
    };
    let inside: Vec<(u32, u32)> = shown.iter().map(at).filter(is_inside).collect();
    if inside.len() < LEAST_PIXELS || 2 * inside.len() < shown.len() {
        return None;
    }
    let step = inside.len().div_ceil(MOST_PIXELS);
    Some(inside.into_iter().step_by(step).collect())
}

/// Finds the interval along rays that fits best; returns its squared difference, and the smear that
/// `nothing` becomes.
fn fit(rays: &[Ray], nothing: Smear) -> Option<(f64, Smear)> {
    let none: f64 = rays.iter().map(Ray::change).sum();
    let error = |steps: Steps| {
        let Products { changes, smears } = rays.iter().map(|ray| ray.products(steps)).sum();
        let weight = if smears > 0.0 {
            (changes / smears).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let error = none - 2.0 * weight * changes + weight * weight * smears;
        (error.max(0.0), weight)
    };
    let stride = FINE / COARSE;
    let coarse = (0..=2 * HALF).step_by(stride);
    let all = coarse.clone().flat_map(|first| {
        (coarse.clone()).filter_map(move |last| (first <= last).then_some([first, last]))
    });
    let mut best = least(all, &error)?;
    let mut around = stride;
    while around > 1 {
        around /= 2;
        let near = |step: usize| {
            [
                step.saturating_sub(around),
                step,
                (step + around).min(2 * HALF),
            ]
        };
        let (firsts, lasts) = (near(best.2[0]), near(best.2[1]));
        let next = firsts.into_iter().flat_map(|first| {
            (lasts.into_iter()).filter_map(move |last| (first <= last).then_some([first, last]))
        });
        best = least(next, &error)?;
    }
    let (error, weight, steps) = best;
    // A pixel shows at a time what was ahead of it by as much at the instant.
    let [close, open] = steps.map(|step| (HALF as f64 - step as f64) / FINE as f64);
    let smear = Smear {
        open,
        close,
        weight,
        rest: (error / none).sqrt(),
        ..nothing
    };
    Some((error, smear))
}

impl Smear {
    /// The smear of a filter that changes nothing.
    fn nothing(motion: f64) -> Self {
        Self {
            motion,
            direction: SmearDirection::Along,
            open: 0.0,
            close: 0.0,
            weight: 0.0,
            rest: 1.0,
        }
    }
}

fn square(color: &[f64; 3]) -> f64 {
    color.iter().map(|part| part * part).sum()
}

/// Finds the interval with the least error; returns error, weight and interval.
fn least(
    all: impl Iterator<Item = Steps>,
    error: &(impl Fn(Steps) -> (f64, f64) + Sync),
) -> Option<(f64, f64, Steps)> {
    let all: Vec<Steps> = all.collect();
    let errors = all.into_par_iter().map(|steps| {
        let (error, weight) = error(steps);
        (error, weight, steps)
    });
    // The first of equal ones, whichever thread finds it.
    errors.min_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)))
}

/// Sums over pixels: of the picture's change times the smear's, and of the smear's squared.
struct Products {
    changes: f64,
    smears: f64,
}

impl Sum for Products {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        let nothing = Self {
            changes: 0.0,
            smears: 0.0,
        };
        all.fold(nothing, |sum, other| Self {
            changes: sum.changes + other.changes,
            smears: sum.smears + other.smears,
        })
    }
}

/// Follows the frame's colours through a pixel, [`HALF`] steps to either side.
fn trace_ray(frame: &Frame, picture: &Image, (x, y): (u32, u32), displacement: [f64; 2]) -> Ray {
    let mut sums = vec![[0.0; 3]];
    let mut sum = [0.0; 3];
    for step in 0..=2 * HALF {
        let ahead = (step as f64 - HALF as f64) / FINE as f64;
        let place = [
            f64::from(x) + ahead * displacement[0],
            f64::from(y) + ahead * displacement[1],
        ];
        let color = interpolate(&frame.color, place);
        for (sum, color) in sum.iter_mut().zip(color) {
            *sum += color;
        }
        sums.push(sum);
    }
    let [sharp, blurred] = [&frame.color, picture].map(|image| image.at(x, y).map(f64::from));
    Ray {
        frame: sharp,
        change: std::array::from_fn(|c| blurred[c] - sharp[c]),
        sums,
    }
}

impl Ray {
    /// Returns the squared change of the picture from the frame.
    fn change(&self) -> f64 {
        square(&self.change)
    }

    /// Returns the products for the smear over some steps.
    fn products(&self, [first, last]: Steps) -> Products {
        let count = (last + 1 - first) as f64;
        let (from, to) = (self.sums[first], self.sums[last + 1]);
        let smear: [f64; 3] = std::array::from_fn(|c| (to[c] - from[c]) / count - self.frame[c]);
        let times = |other: &[f64; 3]| smear.iter().zip(other).map(|(a, b)| a * b).sum();
        Products {
            changes: times(&self.change),
            smears: times(&smear),
        }
    }
}

/// Interpolates colours between four pixels; at the border they go on.
fn interpolate(image: &Image, [x, y]: [f64; 2]) -> [f64; 3] {
    let (left, top) = (x.floor(), y.floor());
    let [across, down] = [x - left, y - top];
    let at = |x: f64, y: f64| {
        let column = x.clamp(0.0, f64::from(image.width - 1)) as u32;
        let row = y.clamp(0.0, f64::from(image.height - 1)) as u32;
        image.at(column, row).map(f64::from)
    };
    let [a, b, c, d] = [
        at(left, top),
        at(left + 1.0, top),
        at(left, top + 1.0),
        at(left + 1.0, top + 1.0),
    ];
    std::array::from_fn(|channel| {
        let upper = a[channel] + across * (b[channel] - a[channel]);
        let lower = c[channel] + across * (d[channel] - c[channel]);
        upper + down * (lower - upper)
    })
}
