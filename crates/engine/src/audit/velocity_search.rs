//! Search for the causes of a wrong velocity.

use frame::Vectors;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::ClearPixels;
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::LEAST_EXPLAINED;
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::fitted_motion::{
    Candidate, TOLERANCE, find_offset, fit_candidates, fit_to_object, is_of_no_unit, length,
};

/// Largest end-point error of a correct velocity relative to the speed, beyond the one in pixels.
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

/// What the causes of a wrong velocity are searched in.
pub struct Search<'a> {
    pub buffer: &'a Vectors,
    pub expected: &'a ExpectedMotion,
    /// Objects with the right velocity.
    pub right: Vec<&'a ClearPixels>,
    /// True if one of them moves. Then objects may lack a part of their motion, and factors look
    /// like it by chance.
    pub some_move_right: bool,
}

impl Search<'_> {
    /// Finds one cause for all wrong objects, which leaves the others unchanged, or a cause for
    /// each. `judged` are all objects; wrong ones have names.
    pub fn explain(&self, judged: &[&ClearPixels], wrong: &[(&ClearPixels, &str)]) -> Vec<Defect> {
        let pixels: Vec<usize> = (wrong.iter())
            .flat_map(|(region, _)| region.pixels.iter().copied())
            .collect();
        let is_all = wrong.len() > 1 || wrong.len() == judged.len();
        let explain_all = |is_tried: &dyn Fn(&Cause) -> bool| {
            let cause = is_all.then(|| self.explain_all(judged, &pixels, is_tried));
            Some(vec![Defect::new(Buffer::Velocity, None, cause.flatten()?)])
        };
        let explain_structure = || {
            let each = wrong.iter();
            each.map(|(region, name)| self.explain_structure(&region.pixels, name))
                .collect::<Option<Vec<Defect>>>()
        };
        let by_structure = self.some_move_right.then(|| {
            let missing = |cause: &Cause| cause.is_missing_motion();
            explain_all(&missing).or_else(explain_structure)
        });
        let may_be = |cause: &Cause| !(self.some_move_right && is_of_no_unit(cause));
        let each = wrong.iter();
        (by_structure.flatten())
            .or_else(|| explain_all(&may_be))
            .unwrap_or_else(|| {
                each.map(|(region, name)| self.explain_object(&region.pixels, name))
                    .collect()
            })
    }

    fn explain_all(
        &self,
        judged: &[&ClearPixels],
        wrong: &[usize],
        is_tried: &dyn Fn(&Cause) -> bool,
    ) -> Option<Explanation> {
        let right = &self.expected.right.velocity;
        TURNS.into_iter().find_map(|turn| {
            let buffer = turn_back(self.buffer, turn);
            let mut fitted = fit_candidates(&buffer, right, wrong);
            // Jitter moves the whole picture.
            fitted.push(find_offset(&buffer, right, wrong));
            let explains = |velocity: &Vectors| {
                let shares = judged.iter();
                let shares = shares.map(|region| share(&buffer, velocity, &region.pixels));
                shares.fold(1.0, f64::min)
            };
            let candidates = self.expected.mistaken.iter().chain(&fitted);
            let tried = candidates.filter(|(cause, _)| is_tried(cause));
            find_cause(tried, turn, &explains)
        })
    }

    /// Finds what an object lacks, or an offset on it: on all of it, or on its wrong pixels.
    fn explain_structure(&self, pixels: &[usize], name: &str) -> Option<Defect> {
        let is_structural = |cause: &Cause| cause.is_missing_motion() || cause.is_offset();
        self.explain_parts(pixels, name, None, &is_structural)
    }

    /// Finds the cause of an object's wrong velocity: one for all of it, or one for its wrong
    /// pixels.
    fn explain_object(&self, pixels: &[usize], name: &str) -> Defect {
        let structure = self
            .some_move_right
            .then(|| self.explain_structure(pixels, name));
        let any = |turn| self.explain_parts(pixels, name, turn, &|_| true);
        let defect = structure.flatten();
        defect
            .or_else(|| TURNS.into_iter().find_map(any))
            .unwrap_or_else(|| {
                let unknown = Explanation::by(Cause::Unknown, 0.0);
                let part = self.select_wrong(pixels).len() as f64 / pixels.len() as f64;
                Defect::new(Buffer::Velocity, Some(name), unknown).in_part(Some(part))
            })
    }

    fn explain_parts(
        &self,
        pixels: &[usize],
        name: &str,
        turn: Option<Cause>,
        is_tried: &dyn Fn(&Cause) -> bool,
    ) -> Option<Defect> {
        let wrong = self.select_wrong(pixels);
        let part = wrong.len() as f64 / pixels.len() as f64;
        let parts = [(pixels, None), (wrong.as_slice(), Some(part))];
        parts.into_iter().find_map(|(some, part)| {
            let mut cause = self.explain_pixels(some, turn, is_tried)?;
            cause.convention_holds = self.right_objects_contradict(&cause);
            Some(Defect::new(Buffer::Velocity, Some(name), cause).in_part(part))
        })
    }

    fn select_wrong(&self, pixels: &[usize]) -> Vec<usize> {
        let right = &self.expected.right.velocity;
        let is_wrong = |at: &usize| !is_close(self.buffer.pixels[*at], right.pixels[*at]);
        pixels.iter().copied().filter(is_wrong).collect()
    }

    fn explain_pixels(
        &self,
        pixels: &[usize],
        turn: Option<Cause>,
        is_tried: &dyn Fn(&Cause) -> bool,
    ) -> Option<Explanation> {
        let buffer = turn_back(self.buffer, turn);
        let fitted = fit_to_object(&buffer, &self.expected.right.velocity, pixels);
        // The most specific words first.
        let is_specific =
            |cause: &Cause| matches!(cause, Cause::DeformationMissing | Cause::OwnMotionMissing);
        let words = || self.expected.mistaken.iter();
        let specific = words().filter(|(cause, _)| is_specific(cause));
        let others = words().filter(|(cause, _)| !is_specific(cause));
        let candidates = specific.chain(others).chain(&fitted);
        let tried = candidates.filter(|(cause, _)| is_tried(cause));
        find_cause(tried, turn, &|velocity| share(&buffer, velocity, pixels))
    }

    /// Returns whether a unit, sign or axis as wrong as an object's would make right objects wrong.
    fn right_objects_contradict(&self, cause: &Explanation) -> bool {
        let right = &self.expected.right.velocity;
        let buffer = turn_back(self.buffer, cause.turned);
        let [velocity, turned] = [
            right.map(|vector| cause.cause.apply(*vector)),
            right.clone(),
        ];
        let contradicts = |buffer: &Vectors, velocity: &Vectors| {
            let mut regions = self.right.iter();
            regions.any(|region| share(buffer, velocity, &region.pixels) < LEAST_EXPLAINED)
        };
        contradicts(&buffer, &velocity) || cause.turned.is_some() && contradicts(&buffer, &turned)
    }
}

/// Undoes a wrong sign or axis.
fn turn_back(buffer: &Vectors, turn: Option<Cause>) -> Vectors {
    buffer.map(|vector| turn.map_or(*vector, |turn| turn.apply(*vector)))
}

/// Finds the first cause that explains the most, and equally good ones. After a turn, the cause is
/// not another turn.
fn find_cause<'a>(
    candidates: impl Iterator<Item = &'a Candidate>,
    turned: Option<Cause>,
    explains: &dyn Fn(&Vectors) -> f64,
) -> Option<Explanation> {
    let shares: Vec<(Cause, f64)> = candidates
        .filter(|(cause, _)| {
            turned.is_none() || !TURNS.contains(&Some(*cause)) && !cause.is_offset()
        })
        .map(|(cause, velocity)| (*cause, explains(velocity)))
        .collect();
    let most = shares.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let mut best = (shares.into_iter()).filter(|(_, share)| *share >= most - LOOKS_SAME);
    let (cause, explained) = best.next()?;
    // A fitted number explains what a word explains; that is no other cause. One missing motion is
    // enough.
    let mut is_missing = cause.is_missing_motion();
    let is_other = |cause: &Cause| {
        let is_known = is_missing && cause.is_missing_motion();
        is_missing |= cause.is_missing_motion();
        cause.is_word() && !is_known
    };
    let others: Vec<Cause> = best.map(|(cause, _)| cause).filter(is_other).collect();
    (explained >= LEAST_EXPLAINED).then(|| Explanation {
        turned,
        looks_like: others,
        ..Explanation::by(cause, explained)
    })
}

/// Computes the part of some pixels at which two velocities are the same.
pub fn share(a: &Vectors, b: &Vectors, pixels: &[usize]) -> f64 {
    let same = pixels
        .iter()
        .filter(|at| is_close(a.pixels[**at], b.pixels[**at]));
    same.count() as f64 / pixels.len() as f64
}

fn is_close(a: [f32; 2], b: [f32; 2]) -> bool {
    length(difference(a, b)) <= TOLERANCE + RELATIVE_TOLERANCE * length(b.map(f64::from))
}

pub fn difference(a: [f32; 2], b: [f32; 2]) -> [f64; 2] {
    [0, 1].map(|axis| f64::from(a[axis]) - f64::from(b[axis]))
}
