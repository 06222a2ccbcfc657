//! Simple causes of a velocity that does not carry: other velocities that would.

use frame::Vectors;
use glam::DVec2;
use serde::Serialize;

use crate::audit_self::block::Block;
use crate::audit_self::fit::Equations;
use crate::audit_self::frame_pair::{FramePair, Seen, to_vector};
use crate::capture::folder::Capture;
use crate::statistics::median;

/// Largest part of what velocity leaves unexplained that a cause may leave.
const LEAST_GAIN: f64 = 0.5;
/// Ratio of what two causes leave unexplained up to which they look the same.
const LOOKS_SAME: f64 = 1.15;
/// What is left unexplained of pictures that are alike.
const LITTLE: f64 = 0.005;
/// Smallest median difference of a cause's velocity from the engine's, in pixels.
const LEAST_DIFFERENCE: f64 = 0.1;

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
            right: follow(velocity, &next.velocity, 1.0),
        });
    }
    candidates.push(Candidate {
        cause: SimpleCause::FrameEarly,
        right: follow(velocity, &pair.before.velocity, -1.0),
    });
    candidates
}

/// Reads another frame's velocity where each surface was or will be.
fn follow(velocity: &Vectors, other: &Vectors, frames: f64) -> Vectors {
    let width = velocity.width as usize;
    let place = |at: usize| {
        let pixel = DVec2::new((at % width) as f64, (at / width) as f64);
        let motion = to_vector(if frames > 0.0 { other } else { velocity }.pixels[at]);
        let last = DVec2::new(f64::from(other.width - 1), f64::from(other.height - 1));
        (pixel + frames * motion).round().clamp(DVec2::ZERO, last)
    };
    let read = |at: usize| {
        let place = place(at);
        *other.at(place.x as u32, place.y as u32)
    };
    Vectors {
        width: velocity.width,
        height: velocity.height,
        pixels: (0..velocity.pixels.len()).map(read).collect(),
    }
}

/// What a wrong velocity is explained by.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CauseFound {
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
) -> Option<CauseFound> {
    let velocity = &pair.after.velocity;
    let unexplained = |velocity: &Vectors| measure_unexplained(pair, blocks, velocity);
    let now = unexplained(velocity);
    let offset = shift.map(|shift| {
        let change = [shift.x as f32, shift.y as f32];
        unexplained(&velocity.map(|[x, y]| [x - change[0], y - change[1]]))
    });
    let differs = |right: &Vectors| {
        let pixels = blocks.iter().flat_map(|block| &block.pixels);
        let differences = pixels.map(|at| {
            let [right, engine] = [right.pixels[*at], velocity.pixels[*at]].map(to_vector);
            right.distance(engine)
        });
        median(differences) > LEAST_DIFFERENCE
    };
    let tried = candidates.iter().filter(|candidate| differs(&candidate.right));
    let tried: Vec<(SimpleCause, f64)> = tried
        .map(|candidate| (candidate.cause, unexplained(&candidate.right)))
        .collect();
    let least = tried.iter().map(|(_, left)| *left).fold(f64::INFINITY, f64::min);
    let is_as_good = |left: f64| left <= LOOKS_SAME * least + LITTLE;
    let is_clear = least <= LEAST_GAIN * now
        && offset.is_none_or(|offset| least <= LOOKS_SAME * offset + LITTLE);
    let mut best = tried.into_iter().filter(|(_, left)| is_as_good(*left));
    let first = best.next().filter(|_| is_clear)?;
    Some(CauseFound {
        cause: first.0,
        looks_like: best.map(|(cause, _)| cause).collect(),
    })
}

/// Measures the part of some blocks' detail that a velocity does not explain: pixels that it leads
/// to other surfaces count whole, those that it leads out of the picture do not count.
fn measure_unexplained(pair: &FramePair, blocks: &[Block], velocity: &Vectors) -> f64 {
    let mut left = 0.0;
    let mut all = 0.0;
    for block in blocks {
        let seen = block.pixels.iter();
        let seen = seen.map(|at| pair.look(*at, pair.place(*at, velocity)));
        let wrong = seen.clone().filter(|seen| matches!(seen, Seen::Hidden | Seen::Behind));
        let wrong = wrong.count() as f64;
        let same = seen.filter(|seen| *seen == Seen::Same).count() as f64;
        let correlation = Equations::at(pair, block, velocity, DVec2::ZERO)
            .map_or(0.0, |equations| equations.correlation.max(0.0));
        left += wrong + same * (1.0 - correlation);
        all += wrong + same;
    }
    if all > 0.0 { left / all } else { 1.0 }
}
