//! Verdicts on regions, from the evidence of their blocks.

use glam::DVec2;
use serde::Serialize;

use crate::audit_self::block::Block;
use crate::audit_self::block_match::{Match, Shifted};
use crate::audit_self::estimate::{Estimate, WIDEST, median_shift};
use crate::audit_self::frame_pair::Seen;

/// Largest bias of a right velocity, in pixels.
const TOLERANCE: f64 = 0.1;
/// Half widths of the 95 % interval by which a bias must exceed zero: about four standard errors,
/// since many regions of many frames are compared.
const LEAST_HALF_WIDTHS: f64 = 2.0;
/// Part of a region's blocks with detail that must be off before it is wrong: shadows and highlights
/// that pass make a few seem so.
const LEAST_OFF: f64 = 0.3;
/// Smallest number of such blocks.
const LEAST_BLOCKS: usize = 2;
/// Common shift of a few blocks that is wrong without an interval, in pixels.
const LEAST_OTHER: f64 = 1.0;
/// Part of the blocks with detail that must be alike before a region is judged by them.
const LEAST_ALIKE: f64 = 0.5;
/// Part of a region's visible pixels that lead behind their surface, from which on it is wrong.
const LEAST_BEHIND: f64 = 0.03;
/// Smallest number of these pixels.
const LEAST_BEHIND_PIXELS: f64 = 9.0;

/// Verdict on a velocity: does it lead to the frame before?
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It does, within the tolerance or the interval.
    Carries,
    /// All of it is wrong by one vector.
    IsOff,
    /// It is not the motion of the picture.
    IsNotTheMotion,
    /// The pictures do not tell.
    CannotTell(Reason),
}

/// Reason why the pictures do not tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Too few pixels are visible in both frames, well inside the region.
    TooSmall,
    /// The brightness is even.
    NoDetail,
    /// No motion makes the pictures alike: noise, light or a longer motion.
    Unlike,
    /// The interval is too wide.
    TooWide,
}

impl Reason {
    /// Names the reason in a few words.
    pub fn name(self) -> &'static str {
        match self {
            Self::TooSmall => "too small",
            Self::NoDetail => "no detail",
            Self::Unlike => "noise or light",
            Self::TooWide => "too few pixels",
        }
    }
}

/// Pixels of a region by what becomes of them, as parts of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shares {
    /// Compared, with detail.
    pub compared: f64,
    /// At edges, where colours are mixed.
    pub edges: f64,
    /// Outside the frame before.
    pub outside: f64,
    /// Hidden in the frame before.
    pub hidden: f64,
    /// Where velocity leads behind the surface: the surface was not there.
    pub behind: f64,
    /// Without detail.
    pub even: f64,
    /// Not alike, whatever the shift.
    pub unlike: f64,
}

/// Evidence of the blocks of a region.
pub struct Evidence<'a> {
    pub shifted: Vec<(&'a Block, Shifted)>,
    pub even: usize,
    pub unlike: usize,
    pub shares: Shares,
    pub estimate: Option<Estimate>,
    /// Pixels of the region.
    pub pixels: usize,
}

impl<'a> Evidence<'a> {
    /// Counts the blocks of a region by their match, and its pixels by what the frame before shows.
    pub fn of(blocks: &'a [Block], matches: &[Match], seen: &[Seen]) -> Self {
        let all = seen.len().max(1) as f64;
        let share = |kind: Seen| seen.iter().filter(|seen| **seen == kind).count() as f64 / all;
        let pixels = |is_counted: &dyn Fn(&Match) -> bool| {
            let counted = blocks
                .iter()
                .zip(matches)
                .filter(|(_, state)| is_counted(state));
            counted.map(|(block, _)| block.pixels.len()).sum::<usize>() as f64 / all
        };
        let [even, unlike] = [
            pixels(&|state| matches!(state, Match::Even)),
            pixels(&|state| matches!(state, Match::Unlike)),
        ];
        let count =
            |is_counted: &dyn Fn(&&Match) -> bool| matches.iter().filter(is_counted).count();
        Self {
            shifted: (blocks.iter().zip(matches))
                .filter_map(|(block, state)| match state {
                    Match::Shift(shifted) => Some((block, *shifted)),
                    _ => None,
                })
                .collect(),
            even: count(&|state| matches!(state, Match::Even)),
            unlike: count(&|state| matches!(state, Match::Unlike)),
            shares: Shares {
                compared: (share(Seen::Same) - even - unlike).max(0.0),
                edges: share(Seen::Edge),
                outside: share(Seen::Outside),
                hidden: share(Seen::Hidden),
                behind: share(Seen::Behind),
                even,
                unlike,
            },
            estimate: None,
            pixels: seen.len(),
        }
    }

    /// Judges a region.
    pub fn judge(&self) -> Verdict {
        let Shares {
            behind,
            edges,
            outside,
            ..
        } = self.shares;
        let clear = 1.0 - edges - outside;
        let is_behind =
            behind * self.pixels as f64 >= LEAST_BEHIND_PIXELS && behind >= LEAST_BEHIND * clear;
        let alike = self.shifted.len();
        let detailed = alike + self.unlike;
        let off = self
            .shifted
            .iter()
            .filter(|(_, shifted)| shifted.is_off)
            .count();
        let is_off = off >= LEAST_BLOCKS && off as f64 >= LEAST_OFF * detailed as f64;
        let verdict = match (alike, self.estimate) {
            _ if is_off => self.judge_off(),
            (0, _) if self.unlike > 0 => Verdict::CannotTell(Reason::Unlike),
            (0, _) if self.even > 0 => Verdict::CannotTell(Reason::NoDetail),
            (0, _) => Verdict::CannotTell(Reason::TooSmall),
            _ if (alike as f64) < LEAST_ALIKE * detailed as f64 => {
                Verdict::CannotTell(Reason::Unlike)
            }
            (_, None) => Verdict::CannotTell(Reason::TooWide),
            (_, Some(estimate)) if is_biased(&estimate) => Verdict::IsOff,
            (_, Some(_)) => Verdict::Carries,
        };
        match verdict {
            Verdict::CannotTell(_) | Verdict::Carries if is_behind => Verdict::IsNotTheMotion,
            verdict => verdict,
        }
    }

    /// Decides between one offset of the whole region and another motion.
    fn judge_off(&self) -> Verdict {
        let middle = median_shift(&self.shifted);
        let is_near = |shifted: &Shifted| shifted.fit.shift.distance(middle) <= WIDEST;
        let near = self.shifted.iter().filter(|(_, shifted)| is_near(shifted));
        let is_one = near.count() as f64 >= (1.0 - LEAST_OFF) * self.shifted.len() as f64;
        match self.estimate {
            Some(estimate) if is_one && is_biased(&estimate) => Verdict::IsOff,
            _ if is_one && middle.length() < LEAST_OTHER => Verdict::CannotTell(Reason::TooWide),
            _ => Verdict::IsNotTheMotion,
        }
    }

    /// Returns the offset that explains a wrong velocity best, if one does.
    pub fn best_offset(&self) -> Option<DVec2> {
        let estimate = self.estimate.map(|estimate| DVec2::from(estimate.bias));
        estimate.or_else(|| (!self.shifted.is_empty()).then(|| median_shift(&self.shifted)))
    }
}

fn is_biased(estimate: &Estimate) -> bool {
    estimate.size() > TOLERANCE && estimate.size() > LEAST_HALF_WIDTHS * estimate.half_width_along
}
