//! Audit of velocity: the end-point error per object, and the cause of errors.

use frame::Vectors;
use serde::Serialize;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::{ClearPixels, select_judged};
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::LEAST_EXPLAINED;
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::fitted_motion::{TOLERANCE, find_offset, fit_candidates, fit_scale, length};
use crate::statistics::{median, percentile};

/// The same, relative to the speed.
const RELATIVE_TOLERANCE: f64 = 0.01;
/// Part of the pixels on which two causes may differ and still look the same.
const LOOKS_SAME: f64 = 0.005;
/// Signs and axes that may be wrong together with another cause; none first.
const TURNS: [Option<Cause>; 4] = [
    None,
    Some(Cause::WrongSign),
    Some(Cause::FlippedY),
    Some(Cause::FlippedX),
];

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
    /// Factor that fits the engine's velocity best; none for a still object.
    pub scale: Option<f64>,
    /// True if the velocity is correct.
    pub is_right: bool,
}

/// Compares velocity object by object; also returns what is wrong.
pub fn audit_velocity(
    found: &Vectors,
    expected: &ExpectedMotion,
    regions: &[ClearPixels],
    names: &[String],
) -> (Vec<ObjectAudit>, Vec<Defect>) {
    let judged = select_judged(regions);
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
    let pixels: Vec<usize> = wrong.iter().flat_map(|it| it.pixels.clone()).collect();
    let is_all = wrong.len() > 1 || wrong.len() == judged.len();
    if is_all && let Some(found) = explain_all(found, expected, &judged, &pixels) {
        let defect = Defect::new(Buffer::Velocity, None, found);
        return (objects, vec![defect]);
    }
    let findings = wrong.iter().map(|region| {
        let name = &names[region.object as usize];
        explain_object(found, expected, &region.pixels, name)
    });
    let findings = findings.collect();
    (objects, findings)
}

/// Finds one cause for everything, which leaves correct objects unchanged; `wrong` are the pixels of wrong objects.
fn explain_all(
    found: &Vectors,
    expected: &ExpectedMotion,
    judged: &[&ClearPixels],
    wrong: &[usize],
) -> Option<Explanation> {
    let right = &expected.right.velocity;
    TURNS.into_iter().find_map(|turn| {
        let found = turn_back(found, turn);
        let mut fitted = fit_candidates(&found, right, wrong);
        // Jitter moves the whole picture.
        fitted.push(find_offset(&found, right, wrong));
        let explains = |velocity: &Vectors| {
            let shares = judged.iter();
            let shares = shares.map(|region| share(&found, velocity, &region.pixels));
            shares.fold(1.0, f64::min)
        };
        find_cause(expected.mistaken.iter().chain(&fitted), turn, &explains)
    })
}

/// Finds the cause of an object's wrong velocity: one for all of it, or one for its wrong pixels.
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
    for turn in TURNS {
        let found = turn_back(found, turn);
        for (some, part) in [(pixels, None), (&wrong, Some(part))] {
            let fitted = fit_candidates(&found, right, some);
            let candidates = expected.mistaken.iter().chain(&fitted);
            let explains = |velocity: &Vectors| share(&found, velocity, some);
            if let Some(cause) = find_cause(candidates, turn, &explains) {
                return Defect::new(Buffer::Velocity, Some(name), cause).in_part(part);
            }
        }
    }
    let unknown = Explanation::by(Cause::Unknown, 0.0);
    Defect::new(Buffer::Velocity, Some(name), unknown).in_part(Some(part))
}

/// Undoes a wrong sign or axis.
fn turn_back(found: &Vectors, turn: Option<Cause>) -> Vectors {
    found.map(|it| turn.map_or(*it, |turn| turn.turn(*it)))
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
    let speed = |at: &usize| length(right.pixels[*at].map(f64::from));
    let speed = median(region.pixels.iter().map(speed));
    let at_part = |part: f64| percentile(&errors, part).expect("a judged object has pixels");
    let width = found.width as usize;
    ObjectAudit {
        object: name.to_owned(),
        pixels: region.pixels.len(),
        speed,
        median: at_part(0.5),
        p95: at_part(0.95),
        worst: error(worst),
        worst_at: [(worst % width) as u32, (worst / width) as u32],
        scale: (speed > TOLERANCE).then(|| fit_scale(found, right, &region.pixels, &[0, 1])),
        is_right: share(found, right, &region.pixels) >= LEAST_EXPLAINED,
    }
}

/// Finds the first cause that explains the most, and equally good ones. After a turn, the cause is not another turn.
fn find_cause<'a>(
    candidates: impl Iterator<Item = &'a (Cause, Vectors)>,
    turned: Option<Cause>,
    explains: &dyn Fn(&Vectors) -> f64,
) -> Option<Explanation> {
    let shares: Vec<(Cause, f64)> = candidates
        .filter(|(cause, _)| turned.is_none() || !TURNS.contains(&Some(*cause)))
        .map(|(cause, velocity)| (*cause, explains(velocity)))
        .collect();
    let most = shares.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let mut best = (shares.into_iter()).filter(|(_, share)| *share >= most - LOOKS_SAME);
    let (cause, explained) = best.next()?;
    // A fitted number explains what a word explains; that is no other cause.
    let others = best.map(|(cause, _)| cause).filter(|cause| cause.is_word());
    (explained >= LEAST_EXPLAINED).then(|| Explanation {
        turned,
        cause,
        looks_like: others.collect(),
        explained,
    })
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
