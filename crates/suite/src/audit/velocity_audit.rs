//! Audit of velocity: the end-point error per object, and the cause of what is wrong.

use frame::Vectors;
use serde::Serialize;

use super::cause::{Cause, Defect};
use super::clear_pixels::ClearPixels;
use super::depth_audit::median;
use super::expected_motion::ExpectedMotion;

/// Largest end-point error of a right velocity, in pixels: rounding of half floats, and of an engine's own matrices.
const TOLERANCE: f64 = 0.1;
/// The same as a part of the speed.
const RELATIVE_TOLERANCE: f64 = 0.01;
/// Part of the pixels that must be right, or that a cause must explain.
const LEAST_EXPLAINED: f64 = 0.95;
/// Fewest pixels of an object that is judged.
const FEWEST_PIXELS: usize = 9;
/// Part of the pixels by which two causes may differ and still look the same.
const LOOKS_SAME: f64 = 0.005;
/// Part of the velocities that a limit must cut before it is called one.
const LEAST_CUT: f64 = 0.02;
/// Upper limit on the distinct numbers of a buffer of few bits.
const MOST_STEPS: usize = 1024;

/// Agreement of an engine's velocity with the scene's, for one object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectAudit {
    /// Name of the object.
    pub object: String,
    /// Number of pixels compared.
    pub pixels: usize,
    /// Median of the right speed, in pixels per frame.
    pub speed: f64,
    /// Median of the end-point error, in pixels.
    pub median: f64,
    /// 95th percentile of the end-point error, in pixels.
    pub p95: f64,
    /// Largest end-point error, in pixels.
    pub worst: f64,
    /// Pixel of the largest error.
    pub worst_at: [u32; 2],
    /// Factor that fits the engine's velocity best; none of an object that stands still.
    pub scale: Option<f64>,
    /// True if the velocity is right.
    pub is_right: bool,
}

/// Compares velocity object by object; returns what is wrong as well.
pub fn audit_velocity(
    found: &Vectors,
    expected: &ExpectedMotion,
    regions: &[ClearPixels],
    names: &[String],
) -> (Vec<ObjectAudit>, Vec<Defect>) {
    let judged: Vec<&ClearPixels> = (regions.iter())
        .filter(|region| region.pixels.len() >= FEWEST_PIXELS)
        .collect();
    let objects: Vec<ObjectAudit> = (judged.iter())
        .map(|region| audit_object(found, expected, region, &names[region.object as usize]))
        .collect();
    let wrong: Vec<&ClearPixels> = (judged.iter().zip(&objects))
        .filter(|(_, object)| !object.is_right)
        .map(|(region, _)| *region)
        .collect();
    if wrong.is_empty() {
        return (objects, Vec::new());
    }
    let pixels: Vec<usize> = wrong
        .iter()
        .flat_map(|region| region.pixels.clone())
        .collect();
    let right = &expected.right.velocity;
    let mut fitted = fit_candidates(found, right, &pixels);
    // Jitter moves the whole picture.
    fitted.push(find_offset(found, right, &pixels));
    let candidates = expected.mistaken.iter().chain(&fitted);
    // One cause for everything, if it leaves what is right as it is.
    let explains_all = |velocity: &Vectors| {
        let least = judged
            .iter()
            .map(|region| share(found, velocity, &region.pixels));
        least.fold(1.0, f64::min)
    };
    if (wrong.len() > 1 || wrong.len() == judged.len())
        && let Some((cause, looks_like, explained)) = find_cause(candidates, &explains_all)
    {
        return (
            objects,
            vec![Defect::new(None, cause, looks_like, explained)],
        );
    }
    let findings = wrong.iter().map(|region| {
        let name = &names[region.object as usize];
        explain_object(found, expected, &region.pixels, name)
    });
    let findings = findings.collect();
    (objects, findings)
}

/// Finds the cause of an object's wrong velocity: one for all of it, or one for the pixels that are wrong.
fn explain_object(
    found: &Vectors,
    expected: &ExpectedMotion,
    pixels: &[usize],
    name: &str,
) -> Defect {
    let right = &expected.right.velocity;
    let is_wrong = |at: &usize| !is_close(found.pixels[*at], right.pixels[*at]);
    let wrong: Vec<usize> = pixels.iter().copied().filter(is_wrong).collect();
    let part = wrong.len() as f64 / pixels.len() as f64;
    for (some, part) in [(pixels, None), (&wrong, Some(part))] {
        let fitted = fit_candidates(found, right, some);
        let candidates = expected.mistaken.iter().chain(&fitted);
        let explains = |velocity: &Vectors| share(found, velocity, some);
        if let Some((cause, looks_like, explained)) = find_cause(candidates, &explains) {
            return Defect::new(Some(name), cause, looks_like, explained).in_part(part);
        }
    }
    Defect::new(Some(name), Cause::Unknown, Vec::new(), 0.0).in_part(Some(part))
}

fn audit_object(
    found: &Vectors,
    expected: &ExpectedMotion,
    region: &ClearPixels,
    name: &str,
) -> ObjectAudit {
    let right = &expected.right.velocity;
    let error = |at: usize| length(difference(found.pixels[at], right.pixels[at]));
    let mut errors: Vec<f64> = region.pixels.iter().map(|at| error(*at)).collect();
    errors.sort_by(f64::total_cmp);
    let worst = (region.pixels.iter().copied())
        .max_by(|a, b| error(*a).total_cmp(&error(*b)))
        .expect("a judged object has pixels");
    let product = |a: &Vectors, b: &Vectors| -> f64 {
        (region.pixels.iter())
            .map(|at| dot(a.pixels[*at], b.pixels[*at]))
            .sum()
    };
    let speed = median(
        region
            .pixels
            .iter()
            .map(|at| length(right.pixels[*at].map(f64::from))),
    );
    let width = found.width as usize;
    ObjectAudit {
        object: name.to_owned(),
        pixels: region.pixels.len(),
        speed,
        median: errors[errors.len() / 2],
        p95: errors[(0.95 * (errors.len() - 1) as f64).round() as usize],
        worst: error(worst),
        worst_at: [(worst % width) as u32, (worst / width) as u32],
        scale: (speed > TOLERANCE).then(|| product(found, right) / product(right, right)),
        is_right: share(found, right, &region.pixels) >= LEAST_EXPLAINED,
    }
}

/// Lists causes that have a number, fitted to some pixels, with the velocity that each leads to; the simplest first.
fn fit_candidates(found: &Vectors, right: &Vectors, pixels: &[usize]) -> Vec<(Cause, Vectors)> {
    let mut candidates = Vec::new();
    let fit = |axes: &[usize]| {
        let product = |a: &Vectors, b: &Vectors| -> f64 {
            let terms = pixels.iter().flat_map(|at| {
                axes.iter()
                    .map(|axis| f64::from(a.pixels[*at][*axis]) * f64::from(b.pixels[*at][*axis]))
            });
            terms.sum()
        };
        product(found, right) / product(right, right)
    };
    let scaled = |scales: [f64; 2]| {
        right.map(|right| [0, 1].map(|axis| (scales[axis] * f64::from(right[axis])) as f32))
    };
    let scale = fit(&[0, 1]);
    if scale.is_finite() {
        candidates.push((Cause::Scale(scale), scaled([scale; 2])));
    }
    let scales = [fit(&[0]), fit(&[1])];
    if scales.iter().all(|scale| scale.is_finite()) {
        candidates.push((Cause::ScaleOfAxes(scales), scaled(scales)));
    }
    candidates.extend(list_cut(found, right, pixels));
    candidates.extend(find_steps(found, right, pixels));
    candidates
}

/// Fits one vector that is added to all.
fn find_offset(found: &Vectors, right: &Vectors, pixels: &[usize]) -> (Cause, Vectors) {
    let offset = [0, 1].map(|axis| {
        let error = |at: &usize| f64::from(found.pixels[*at][axis] - right.pixels[*at][axis]);
        median(pixels.iter().map(error))
    });
    let moved = right.map(|right| [0, 1].map(|axis| right[axis] + offset[axis] as f32));
    (Cause::Offset(offset), moved)
}

/// Lists limits on the length and on the axes, where any velocity is cut.
fn list_cut(found: &Vectors, right: &Vectors, pixels: &[usize]) -> Vec<(Cause, Vectors)> {
    let most = |measure: &dyn Fn([f64; 2]) -> f64| {
        let all = pixels
            .iter()
            .map(|at| measure(found.pixels[*at].map(f64::from)));
        all.fold(0.0, f64::max)
    };
    let largest = |[x, y]: [f64; 2]| f64::max(x.abs(), y.abs());
    let cut_part = |limit: f64, measure: &dyn Fn([f64; 2]) -> f64| {
        let beyond = |at: &&usize| measure(right.pixels[**at].map(f64::from)) > limit + TOLERANCE;
        pixels.iter().filter(beyond).count() as f64 / pixels.len() as f64
    };
    let mut list = Vec::new();
    let limit = most(&length);
    if limit > TOLERANCE && cut_part(limit, &length) > LEAST_CUT {
        let cut = right.map(|right| {
            let own = length(right.map(f64::from)).max(f64::MIN_POSITIVE);
            right.map(|part| (f64::from(part) * (limit / own).min(1.0)) as f32)
        });
        list.push((Cause::Clipped(limit), cut));
    }
    let limit = most(&largest);
    if limit > TOLERANCE && cut_part(limit, &largest) > LEAST_CUT {
        let cut = right.map(|right| right.map(|part| part.clamp(-limit as f32, limit as f32)));
        list.push((Cause::ClippedAxes(limit), cut));
    }
    list
}

/// Finds out whether the numbers lie on a grid of few steps, each next to the right number; returns that grid's velocity.
fn find_steps(found: &Vectors, right: &Vectors, pixels: &[usize]) -> Option<(Cause, Vectors)> {
    let count = |vectors: &Vectors, axis: usize| {
        let mut numbers: Vec<f32> = pixels.iter().map(|at| vectors.pixels[*at][axis]).collect();
        numbers.sort_by(f32::total_cmp);
        numbers.dedup();
        numbers
    };
    let gaps = [0, 1].map(|axis| {
        let (own, exact) = (count(found, axis), count(right, axis));
        let is_coarse = own.len() >= 2 && own.len() <= MOST_STEPS && exact.len() >= 2 * own.len();
        is_coarse.then(|| median(own.windows(2).map(|pair| f64::from(pair[1] - pair[0]))))
    });
    let step = gaps.into_iter().flatten().reduce(f64::max)?;
    // Numbers that are nearest on the grid explain themselves.
    let nearest = found.zip(right, |found, right| {
        let is_near = |axis: usize| f64::from((found[axis] - right[axis]).abs()) <= 0.6 * step;
        match is_near(0) && is_near(1) {
            true => *found,
            false => *right,
        }
    });
    (step > TOLERANCE).then_some((Cause::Steps(step), nearest))
}

/// Finds the first cause that explains the most, and those that explain as much.
fn find_cause<'a>(
    candidates: impl Iterator<Item = &'a (Cause, Vectors)>,
    explains: &dyn Fn(&Vectors) -> f64,
) -> Option<(Cause, Vec<Cause>, f64)> {
    let shares: Vec<(Cause, f64)> = candidates
        .map(|(cause, velocity)| (*cause, explains(velocity)))
        .collect();
    let most = shares.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let mut best = (shares.into_iter()).filter(|(_, share)| *share >= most - LOOKS_SAME);
    let (cause, explained) = best.next()?;
    // A fitted number explains what a word explains; that is no other cause.
    let others = best.map(|(cause, _)| cause).filter(|cause| cause.is_word());
    (explained >= LEAST_EXPLAINED).then(|| (cause, others.collect(), explained))
}

/// Computes the part of some pixels at which two velocities are the same.
fn share(a: &Vectors, b: &Vectors, pixels: &[usize]) -> f64 {
    let same = pixels
        .iter()
        .filter(|at| is_close(a.pixels[**at], b.pixels[**at]));
    same.count() as f64 / pixels.len() as f64
}

fn is_close(a: [f32; 2], b: [f32; 2]) -> bool {
    length(difference(a, b)) <= TOLERANCE + RELATIVE_TOLERANCE * length(b.map(f64::from))
}

fn difference(a: [f32; 2], b: [f32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(a[axis]) - f64::from(b[axis]))
}

fn dot(a: [f32; 2], b: [f32; 2]) -> f64 {
    f64::from(a[0]) * f64::from(b[0]) + f64::from(a[1]) * f64::from(b[1])
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}
