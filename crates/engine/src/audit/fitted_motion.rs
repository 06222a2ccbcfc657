//! Causes of wrong velocity with a number, fitted to the engine's velocity.

use std::ops::RangeInclusive;

use frame::Vectors;

use crate::audit::cause::Cause;
use crate::statistics::median;

/// Largest end-point error of a correct velocity, in pixels: rounding of half floats, and of an
/// engine's own matrices.
pub(super) const TOLERANCE: f64 = 0.1;
/// Smallest part of the velocities that a limit must cut.
const LEAST_CUT: f64 = 0.02;
/// Upper limit on the distinct numbers in a buffer of few bits.
const MAX_STEPS: usize = 1024;
/// Factors on the length between these are of no unit: pixels, parts of the picture and seconds
/// differ by more.
const NO_UNIT: RangeInclusive<f64> = 0.8..=1.25;
/// Factor that counts as zero.
const NO_SCALE: f64 = 1e-3;

/// Cause with the velocity that it makes.
pub type Candidate = (Cause, Vectors);

/// Lists causes with a number, fitted to some pixels, with each one's velocity; the simplest first.
pub fn fit_candidates(buffer: &Vectors, right: &Vectors, pixels: &[usize]) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    let fit = |axes: &[usize]| fit_scale(buffer, right, pixels, axes);
    let scaled = |scales: [f64; 2]| {
        right.map(|right| [0, 1].map(|axis| (scales[axis] * f64::from(right[axis])) as f32))
    };
    // A wrong sign is a cause of its own.
    let is_scale = |scale: &f64| scale.is_finite() && *scale > -NO_SCALE;
    let scale = fit(&[0, 1]);
    if is_scale(&scale) {
        candidates.push((Cause::Scale(scale), scaled([scale; 2])));
    }
    let scales = [fit(&[0]), fit(&[1])];
    if scales.iter().all(is_scale) {
        candidates.push((Cause::ScaleOfAxes(scales), scaled(scales)));
    }
    candidates.extend(list_cut(buffer, right, pixels));
    candidates.extend(find_steps(buffer, right, pixels));
    candidates
}

/// Fits the factor from the correct velocity to the engine's, on some axes.
pub fn fit_scale(buffer: &Vectors, right: &Vectors, pixels: &[usize], axes: &[usize]) -> f64 {
    let product = |a: &Vectors, b: &Vectors| -> f64 {
        let terms = pixels.iter().flat_map(|at| {
            axes.iter()
                .map(|axis| f64::from(a.pixels[*at][*axis]) * f64::from(b.pixels[*at][*axis]))
        });
        terms.sum()
    };
    product(buffer, right) / product(right, right)
}

/// Fits one vector added to all.
pub fn find_offset(buffer: &Vectors, right: &Vectors, pixels: &[usize]) -> Candidate {
    let offset = [0, 1].map(|axis| {
        let error = |at: &usize| f64::from(buffer.pixels[*at][axis] - right.pixels[*at][axis]);
        median(pixels.iter().map(error))
    });
    let moved = right.map(|right| [0, 1].map(|axis| right[axis] + offset[axis] as f32));
    (Cause::Offset(offset), moved)
}

/// Returns whether a cause is a factor that no unit makes.
pub fn is_of_no_unit(cause: &Cause) -> bool {
    match cause {
        Cause::Scale(scale) => NO_UNIT.contains(scale),
        Cause::ScaleOfAxes(scales) => scales.iter().all(|scale| NO_UNIT.contains(scale)),
        _ => false,
    }
}

/// Lists limits on the length and on the axes, if any velocity is cut.
fn list_cut(buffer: &Vectors, right: &Vectors, pixels: &[usize]) -> Vec<Candidate> {
    let largest = |[x, y]: [f64; 2]| f64::max(x.abs(), y.abs());
    let find_limit = |measure: fn([f64; 2]) -> f64| {
        let measured = |vectors: &Vectors, at: usize| measure(vectors.pixels[at].map(f64::from));
        let limit = (pixels.iter())
            .map(|at| measured(buffer, *at))
            .fold(0.0, f64::max);
        let beyond = pixels
            .iter()
            .filter(|at| measured(right, **at) > limit + TOLERANCE);
        let cut_part = beyond.count() as f64 / pixels.len() as f64;
        (limit > TOLERANCE && cut_part > LEAST_CUT).then_some(limit)
    };
    let shorter = find_limit(length).map(|limit| {
        let cut = right.map(|right| {
            let speed = length(right.map(f64::from)).max(f64::MIN_POSITIVE);
            right.map(|part| (f64::from(part) * (limit / speed).min(1.0)) as f32)
        });
        (Cause::Clipped(limit), cut)
    });
    let within = find_limit(largest).map(|limit| {
        let cut = right.map(|right| right.map(|part| part.clamp(-limit as f32, limit as f32)));
        (Cause::ClippedAxes(limit), cut)
    });
    shorter.into_iter().chain(within).collect()
}

/// Checks whether the numbers are on a grid of few steps, each next to the correct number; returns
/// that grid's velocity.
fn find_steps(buffer: &Vectors, right: &Vectors, pixels: &[usize]) -> Option<Candidate> {
    let count = |vectors: &Vectors, axis: usize| {
        let mut numbers: Vec<f32> = pixels.iter().map(|at| vectors.pixels[*at][axis]).collect();
        numbers.sort_by(f32::total_cmp);
        numbers.dedup();
        numbers
    };
    let gaps = [0, 1].map(|axis| {
        let (values, exact) = (count(buffer, axis), count(right, axis));
        let is_coarse =
            values.len() >= 2 && values.len() <= MAX_STEPS && exact.len() >= 2 * values.len();
        is_coarse.then(|| median(values.windows(2).map(|pair| f64::from(pair[1] - pair[0]))))
    });
    let step = gaps.into_iter().flatten().reduce(f64::max)?;
    // Numbers already nearest on the grid explain themselves.
    let nearest = buffer.zip(right, |vector, right| {
        let is_near = |axis: usize| f64::from((vector[axis] - right[axis]).abs()) <= 0.6 * step;
        if is_near(0) && is_near(1) {
            *vector
        } else {
            *right
        }
    });
    (step > TOLERANCE).then_some((Cause::Steps(step), nearest))
}

pub(super) fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}
