//! Search for the causes of a wrong velocity.

use frame::Vectors;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::ClearPixels;
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::depth_audit::LEAST_EXPLAINED;
use crate::audit::expected_motion::ExpectedMotion;
use crate::audit::fitted_motion::{
    Candidate, TOLERANCE, find_offset, fit_candidates, is_of_no_unit, length,
};
use crate::audit::ranking::{Ranking, Share};

/// Largest end-point error of a correct velocity relative to the speed, beyond the one in pixels.
const RELATIVE_TOLERANCE: f64 = 0.01;
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
    pub expected: &'a ExpectedMotion<'a>,
    /// Objects with the right velocity.
    pub right: Vec<&'a ClearPixels>,
    /// Decides between causes.
    pub ranking: Ranking,
}

/// Causes that are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tried {
    /// Motions that follow from the scene, and jitter.
    Structures,
    /// Numbers too.
    All,
}

impl Search<'_> {
    /// Finds one cause for all wrong objects, which leaves the others unchanged, or a cause for
    /// each. `judged` are all objects; wrong ones have names.
    pub fn explain(&self, judged: &[&ClearPixels], wrong: &[(&ClearPixels, &str)]) -> Vec<Defect> {
        let is_all = wrong.len() > 1 || wrong.len() == judged.len();
        let explain_all = |tried: Tried| {
            let cause = is_all.then(|| self.explain_all(judged, wrong, tried));
            Some(vec![Defect::new(Buffer::Velocity, None, cause.flatten()?)])
        };
        let explain_structures = || {
            let each = wrong.iter();
            each.map(|(region, name)| self.explain_parts(region, name, None, Tried::Structures))
                .collect::<Option<Vec<Defect>>>()
        };
        let by_structure = self
            .ranking
            .some_move_right
            .then(|| explain_all(Tried::Structures).or_else(explain_structures));
        (by_structure.flatten())
            .or_else(|| explain_all(Tried::All))
            .unwrap_or_else(|| {
                let each = wrong.iter();
                each.map(|(region, name)| self.explain_object(region, name))
                    .collect()
            })
    }

    fn explain_all(
        &self,
        judged: &[&ClearPixels],
        wrong: &[(&ClearPixels, &str)],
        tried: Tried,
    ) -> Option<Explanation> {
        let pixels: Vec<usize> = (wrong.iter())
            .flat_map(|(region, _)| region.pixels.iter().copied())
            .collect();
        let right = &self.expected.right.velocity;
        TURNS.into_iter().find_map(|turn| {
            let buffer = turn_back(self.buffer, turn.as_ref());
            let fitted = match tried {
                Tried::Structures => Vec::new(),
                // Jitter moves the whole picture.
                Tried::All => [
                    fit_candidates(&buffer, right, &pixels),
                    vec![find_offset(&buffer, right, &pixels)],
                ]
                .concat(),
            };
            let fitted = fitted.iter().filter(|(cause, _)| self.may_be(cause));
            let explains = |(cause, velocity): &Candidate| Share {
                cause: cause.clone(),
                part: (judged.iter())
                    .map(|region| share(&buffer, velocity, &region.pixels))
                    .fold(1.0, f64::min),
            };
            let candidates = self.expected.mistaken.iter().chain(fitted);
            self.ranking
                .choose(candidates.map(explains).collect(), turn)
        })
    }

    /// Finds the cause of an object's wrong velocity, or says that it is unknown.
    fn explain_object(&self, region: &ClearPixels, name: &str) -> Defect {
        let structure = (self.ranking.some_move_right)
            .then(|| self.explain_parts(region, name, None, Tried::Structures));
        let any = |turn| self.explain_parts(region, name, turn, Tried::All);
        (structure.flatten())
            .or_else(|| TURNS.into_iter().find_map(any))
            .unwrap_or_else(|| {
                let unknown = Explanation::by(Cause::Unknown, 0.0);
                let part = self.select_wrong(region).pixels.len() as f64;
                let part = part / region.pixels.len() as f64;
                Defect::new(Buffer::Velocity, Some(name), unknown).in_part(Some(part))
            })
    }

    /// Finds one cause for all of an object, or one for its wrong pixels.
    fn explain_parts(
        &self,
        region: &ClearPixels,
        name: &str,
        turn: Option<Cause>,
        tried: Tried,
    ) -> Option<Defect> {
        let wrong = self.select_wrong(region);
        let part = wrong.pixels.len() as f64 / region.pixels.len() as f64;
        let parts = [(region, None), (&wrong, Some(part))];
        parts.into_iter().find_map(|(some, part)| {
            let buffer = turn_back(self.buffer, turn.as_ref());
            let mut shares = self.try_structures(&buffer, some);
            if turn.is_none() {
                shares.extend(self.try_draws_and_jitter(&buffer, some));
            }
            if tried == Tried::All {
                shares.extend(self.try_numbers(&buffer, some, part.is_none()));
            }
            let mut cause = self.ranking.choose(shares, turn.clone())?;
            cause.convention_holds = self.right_objects_contradict(&cause);
            Some(Defect::new(Buffer::Velocity, Some(name), cause).in_part(part))
        })
    }

    fn select_wrong(&self, region: &ClearPixels) -> ClearPixels {
        let right = &self.expected.right.velocity;
        let is_wrong = |at: &usize| !is_close(self.buffer.pixels[*at], right.pixels[*at]);
        ClearPixels {
            pixels: region.pixels.iter().copied().filter(is_wrong).collect(),
            object: region.object,
        }
    }

    /// Tries what an engine may do with every object, the most specific first.
    fn try_structures(&self, buffer: &Vectors, region: &ClearPixels) -> Vec<Share> {
        let is_specific =
            |cause: &Cause| matches!(cause, Cause::DeformationMissing | Cause::OwnMotionMissing);
        // No single object is upside down.
        let is_of_picture = |cause: &Cause| matches!(cause, Cause::UpsideDown);
        let words = || (self.expected.mistaken.iter()).filter(|(cause, _)| !is_of_picture(cause));
        let specific = words().filter(|(cause, _)| is_specific(cause));
        let others = words().filter(|(cause, _)| !is_specific(cause));
        let each = specific.chain(others);
        each.map(|candidate| measure(candidate, buffer, region))
            .collect()
    }

    /// Tries other key shapes, the matrices of other objects, and jitter in the pass of this one.
    fn try_draws_and_jitter(&self, buffer: &Vectors, region: &ClearPixels) -> Vec<Share> {
        let right = &self.expected.right.velocity;
        let object = (region.object as usize).checked_sub(1);
        let draws = &self.expected.draws;
        let of_draws = object.map(|object| {
            let poses = draws.list_poses(object, &region.pixels);
            poses.chain(draws.list_matrices_of_others(object, &region.pixels))
        });
        let jitter = find_offset(buffer, right, &region.pixels);
        let jitter = Some(jitter).filter(|(cause, _)| cause.is_of_jitter());
        let each = of_draws.into_iter().flatten().chain(jitter);
        each.map(|candidate| measure(&candidate, buffer, region))
            .collect()
    }

    /// Tries numbers that fit the vectors of an object. A few of its pixels fit by chance.
    fn try_numbers(&self, buffer: &Vectors, region: &ClearPixels, is_whole: bool) -> Vec<Share> {
        let right = &self.expected.right.velocity;
        let pixels = &region.pixels;
        let object = (region.object as usize).checked_sub(1);
        let mut candidates = fit_candidates(buffer, right, pixels);
        candidates.retain(|(cause, _)| !is_of_no_unit(cause));
        if is_whole {
            let draws = &self.expected.draws;
            candidates
                .extend(object.and_then(|object| draws.find_teleport(buffer, object, pixels)));
            candidates.push(find_offset(buffer, right, pixels));
        }
        let each = candidates.iter();
        each.map(|candidate| measure(candidate, buffer, region))
            .collect()
    }

    fn may_be(&self, cause: &Cause) -> bool {
        !(self.ranking.some_move_right && is_of_no_unit(cause))
    }

    /// Returns whether a unit, sign or axis as wrong as an object's would make right objects wrong.
    fn right_objects_contradict(&self, cause: &Explanation) -> bool {
        let right = &self.expected.right.velocity;
        let buffer = turn_back(self.buffer, cause.turned.as_ref());
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

/// Measures how much of an object a cause explains.
fn measure((cause, velocity): &Candidate, buffer: &Vectors, region: &ClearPixels) -> Share {
    Share {
        cause: cause.clone(),
        part: share(buffer, velocity, &region.pixels),
    }
}

/// Undoes a wrong sign or axis.
fn turn_back(buffer: &Vectors, turn: Option<&Cause>) -> Vectors {
    buffer.map(|vector| turn.map_or(*vector, |turn| turn.apply(*vector)))
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
