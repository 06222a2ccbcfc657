//! Simple causes of a velocity that does not carry: other velocities that would.

use frame::Vectors;
use glam::DVec2;
use serde::Serialize;

use crate::audit_self::block::Block;
use crate::audit_self::block_match::{LEAST_CORRELATION, has_detail};
use crate::audit_self::fit::Equations;
use crate::audit_self::frame_pair::{FramePair, Seen, to_vector};
use crate::capture::folder::Capture;
use crate::statistics::median;

/// Largest part of what velocity leaves unexplained that a cause may leave.
const LEAST_GAIN: f64 = 0.5;
/// Ratio of what two causes leave unexplained up to which they look the same.
const LOOKS_SAME: f64 = 1.15;
/// Standard errors of the difference up to which they do, too.
const LEAST_CERTAINTY: f64 = 2.0;
/// Part of the blocks that a right velocity may leave unexplained.
const LITTLE: f64 = 0.005;
/// Smallest median difference of a cause's velocity from the engine's, in pixels.
const LEAST_DIFFERENCE: f64 = 0.1;

/// Steps that find the place from which a velocity leads to a pixel.
const PLACE_STEPS: usize = 4;

/// Mistake that one changed sign, unit or frame would undo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SimpleCause {
    /// Zero despite motion.
    Zero,
    /// Motion although the picture stands still.
    StandsStill,
    /// Previous minus current.
    WrongSign,
    /// The y axis points the other way.
    FlippedY,
    /// The x axis points the other way.
    FlippedX,
    /// x and y are exchanged.
    SwappedAxes,
    /// Twice the motion.
    TwiceTooLong,
    /// Half the motion.
    HalfAsLong,
    /// The whole buffer of the frame before.
    PreviousBuffer,
    /// The motion from two frames ago to one frame ago.
    FrameLate,
    /// The motion to the next frame.
    FrameEarly,
}

impl SimpleCause {
    /// Describes the mistake, as the continuation of a sentence.
    pub fn name(self) -> &'static str {
        match self {
            Self::Zero => "is zero, but the picture moves",
            Self::StandsStill => "moves, but the picture stands still",
            Self::WrongSign => "has the wrong sign",
            Self::FlippedY => "has y flipped",
            Self::FlippedX => "has x flipped",
            Self::SwappedAxes => "has x and y swapped",
            Self::TwiceTooLong => "is twice too long",
            Self::HalfAsLong => "is half as long",
            Self::PreviousBuffer => "is the whole buffer of the frame before",
            Self::FrameLate => "is one frame late",
            Self::FrameEarly => "is one frame early",
        }
    }
}

/// A cause, and the right velocity if it is the true one.
pub struct Candidate {
    cause: SimpleCause,
    right: Vectors,
}

/// Lists the causes to try, the simplest first. `next` is the frame after the pair.
pub fn list_candidates(pair: &FramePair, next: Option<&Capture>) -> Vec<Candidate> {
    let velocity = &pair.after.velocity;
    let changed = |cause, change: &dyn Fn([f32; 2]) -> [f32; 2]| Candidate {
        cause,
        right: velocity.map(|vector| change(*vector)),
    };
    let mut candidates = vec![
        changed(SimpleCause::StandsStill, &|_| [0.0; 2]),
        changed(SimpleCause::WrongSign, &|[x, y]| [-x, -y]),
        changed(SimpleCause::FlippedY, &|[x, y]| [x, -y]),
        changed(SimpleCause::FlippedX, &|[x, y]| [-x, y]),
        changed(SimpleCause::SwappedAxes, &|[x, y]| [y, x]),
        changed(SimpleCause::TwiceTooLong, &|[x, y]| [0.5 * x, 0.5 * y]),
        changed(SimpleCause::HalfAsLong, &|[x, y]| [2.0 * x, 2.0 * y]),
    ];
    if let Some(next) = next {
        // A late buffer holds this frame's velocity in the next frame.
        candidates.push(Candidate {
            cause: SimpleCause::PreviousBuffer,
            right: next.velocity.clone(),
        });
        candidates.push(Candidate {
            cause: SimpleCause::FrameLate,
            right: read_ahead(&next.velocity),
        });
    }
    candidates.push(Candidate {
        cause: SimpleCause::FrameEarly,
        right: read_back(velocity, &pair.before.velocity),
    });
    candidates
}

/// Reads the next frame's velocity where each surface will be, by that velocity.
fn read_ahead(next: &Vectors) -> Vectors {
    let pixels = (0..next.pixels.len()).map(|at| read_at(next, at, to_vector(next.pixels[at])));
    Vectors {
        pixels: pixels.collect(),
        ..*next
    }
}

/// Reads the velocity of the frame before where each surface was, if it led ahead.
fn read_back(velocity: &Vectors, before: &Vectors) -> Vectors {
    let find = |at: usize| {
        let start = read_at(before, at, -to_vector(velocity.pixels[at]));
        (0..PLACE_STEPS).fold(start, |motion, _| read_at(before, at, -to_vector(motion)))
    };
    Vectors {
        pixels: (0..before.pixels.len()).map(find).collect(),
        ..*before
    }
}

/// Reads the velocity of the pixel that is closest to a pixel moved by a motion.
fn read_at(velocity: &Vectors, at: usize, motion: DVec2) -> [f32; 2] {
    let width = velocity.width as usize;
    let pixel = DVec2::new((at % width) as f64, (at / width) as f64);
    let last = DVec2::new(
        f64::from(velocity.width - 1),
        f64::from(velocity.height - 1),
    );
    let place = (pixel + motion).round().clamp(DVec2::ZERO, last);
    *velocity.at(place.x as u32, place.y as u32)
}

/// Cause of a wrong velocity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedCause {
    pub cause: SimpleCause,
    /// Causes that the pictures do not tell from it.
    pub looks_like: Vec<SimpleCause>,
}

/// Finds the cause that makes the pictures of some blocks most alike; none if none does clearly.
/// `shift` is the best constant offset.
pub fn find_cause(
    pair: &FramePair,
    blocks: &[Block],
    candidates: &[Candidate],
    shift: Option<DVec2>,
) -> Option<NamedCause> {
    let velocity = &pair.after.velocity;
    let offset = shift.map(|shift| {
        let change = [shift.x as f32, shift.y as f32];
        velocity.map(|[x, y]| [x - change[0], y - change[1]])
    });
    let differs = |right: &Vectors| {
        let pixels = blocks.iter().flat_map(|block| &block.pixels);
        let differences = pixels.map(|at| {
            let [right, engine] = [right.pixels[*at], velocity.pixels[*at]].map(to_vector);
            right.distance(engine)
        });
        median(differences) > LEAST_DIFFERENCE
    };
    let candidates: Vec<&Candidate> = (candidates.iter())
        .filter(|candidate| differs(&candidate.right))
        .collect();
    let tried = candidates.iter().map(|candidate| &candidate.right);
    let all: Vec<&Vectors> = std::iter::once(velocity)
        .chain(tried)
        .chain(&offset)
        .collect();
    let mut left = measure_unexplained(pair, blocks, &all).into_iter();
    let now = left.next()?;
    let tried: Vec<(SimpleCause, Unexplained)> = (candidates.iter())
        .map(|candidate| candidate.cause)
        .zip(left.by_ref())
        .collect();
    let parts = tried.iter().map(|(_, unexplained)| unexplained);
    let best = parts.min_by(|one, other| one.part.total_cmp(&other.part))?;
    let limit = |part: f64| LOOKS_SAME * part + LITTLE;
    let offset = left.next().map_or(f64::INFINITY, |offset| offset.part);
    if best.part > LEAST_GAIN * now.part || best.part > limit(offset) {
        return None;
    }
    let is_as_good = |other: &Unexplained| {
        other.part <= limit(best.part)
            || other.part - best.part <= LEAST_CERTAINTY * other.error_beside(best)
    };
    let as_good = tried
        .iter()
        .filter(|(_, unexplained)| is_as_good(unexplained));
    let mut causes = as_good.map(|(cause, _)| *cause);
    Some(NamedCause {
        cause: causes.next()?,
        looks_like: causes.collect(),
    })
}

/// Effect of a velocity on a block.
struct Outcome {
    /// Pixels that it leads to other surfaces.
    wrong: f64,
    /// Pixels that it leads to the same surface.
    same: f64,
    /// Correlation of the pictures there; 0 without detail.
    correlation: f64,
}

impl Outcome {
    fn of(pair: &FramePair, block: &Block, velocity: &Vectors) -> Self {
        let seen = block.pixels.iter();
        let seen = seen.map(|at| pair.look(*at, pair.place(*at, velocity)));
        let wrong = seen
            .clone()
            .filter(|seen| matches!(seen, Seen::Hidden | Seen::Behind));
        let equations = Equations::at(pair, block, velocity, DVec2::ZERO);
        Self {
            wrong: wrong.count() as f64,
            same: seen.filter(|seen| *seen == Seen::Same).count() as f64,
            correlation: equations.map_or(0.0, |equations| equations.correlation.max(0.0)),
        }
    }
}

/// The part of some blocks that a velocity does not explain.
struct Unexplained {
    part: f64,
    /// How far each block moves the part.
    influences: Vec<f64>,
}

impl Unexplained {
    /// Sums up pairs of what is left of a block and all of it.
    fn of(blocks: &[[f64; 2]]) -> Self {
        let sum = |which: usize| blocks.iter().map(|block| block[which]).sum::<f64>();
        let all = sum(1) + f64::EPSILON;
        let part = sum(0) / all;
        let influence = |[left, of]: &[f64; 2]| (left - part * of) / all;
        Self {
            part,
            influences: blocks.iter().map(influence).collect(),
        }
    }

    /// The standard error of the difference from another part of the same blocks (Cochran 1977,
    /// "Sampling Techniques", section 6.4).
    fn error_beside(&self, other: &Self) -> f64 {
        let pairs = std::iter::zip(&self.influences, &other.influences);
        let squares = pairs.map(|(one, other)| (one - other).powi(2));
        squares.sum::<f64>().sqrt()
    }
}

/// Measures the part of some blocks that each velocity does not explain. Pixels that it leads to
/// other surfaces count whole, and those that it leads out of the picture do not count. The detail
/// of a block counts if one of the velocities makes both pictures of it alike: light may change
/// too.
fn measure_unexplained(
    pair: &FramePair,
    blocks: &[Block],
    velocities: &[&Vectors],
) -> Vec<Unexplained> {
    let mut parts = vec![Vec::with_capacity(blocks.len()); velocities.len()];
    for block in blocks {
        let outcomes = velocities
            .iter()
            .map(|velocity| Outcome::of(pair, block, velocity));
        let outcomes: Vec<Outcome> = outcomes.collect();
        let best = outcomes
            .iter()
            .map(|outcome| outcome.correlation)
            .fold(0.0, f64::max);
        let counts = best >= LEAST_CORRELATION && has_detail(pair, block);
        for (part, outcome) in parts.iter_mut().zip(&outcomes) {
            let unlike = if counts {
                1.0 - outcome.correlation
            } else {
                0.0
            };
            part.push([
                outcome.wrong + outcome.same * unlike,
                outcome.wrong + outcome.same,
            ]);
        }
    }
    parts.iter().map(|part| Unexplained::of(part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes the unexplained part of four blocks of ten pixels.
    fn part_of(left: [f64; 4]) -> Unexplained {
        Unexplained::of(&left.map(|left| [left, 10.0]))
    }

    #[test]
    fn a_difference_is_as_certain_as_the_blocks_agree() {
        let least = part_of([1.0, 2.0, 3.0, 2.0]);
        assert!((least.part - 0.2).abs() < 1e-12);
        // All blocks agree.
        let more = part_of([2.0, 3.0, 4.0, 3.0]);
        assert!((more.part - 0.3).abs() < 1e-12);
        assert!(more.error_beside(&least) < 1e-12);
        // The same difference comes from one block: 4 pixels of 40, less their mean of 1 per block.
        let noisy = part_of([1.0, 2.0, 7.0, 2.0]);
        assert!((noisy.part - 0.3).abs() < 1e-12);
        let expected = 12_f64.sqrt() / 40.0;
        assert!((noisy.error_beside(&least) - expected).abs() < 1e-12);
    }
}
