//! Audit of two consecutive frames, region by region.

use frame::Raster;
use rayon::prelude::*;
use serde::Serialize;

use crate::audit_self::block::{Block, Region, divide};
use crate::audit_self::block_match::{Match, match_block};
use crate::audit_self::estimate::Estimate;
use crate::audit_self::frame_pair::{FramePair, Seen, to_vector};
use crate::audit_self::map::MapPixel;
use crate::audit_self::simple_cause::{
    Candidate, NamedCause, SimpleCause, find_cause, list_candidates,
};
use crate::audit_self::verdict::{Evidence, Shares, Verdict};
use crate::capture::folder::Capture;
use crate::statistics::median;

/// Range of a search for the picture's motion, in pixels.
const REACHES: [i32; 2] = [8, 48];
/// The same, in parts of the picture's width.
const REACH: u32 = 10;
/// Speed up to which a velocity is zero, in pixels per frame.
const STILL: f64 = 0.01;

/// The velocity of one region in one frame, compared with the frame before.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RegionAudit {
    /// Object, or part of the picture.
    pub region: String,
    /// Number of its pixels.
    pub pixels: usize,
    /// Parts of them.
    pub shares: Shares,
    /// Median speed by the engine's velocity, in pixels per frame.
    pub speed: f64,
    /// The error of its velocity; none if the pictures do not tell.
    pub error: Option<Estimate>,
    /// Verdict.
    pub verdict: Verdict,
    /// Cause of a wrong velocity, if a simple one explains it.
    pub cause: Option<NamedCause>,
}

/// Audit of one frame against the frame before.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PairAudit {
    /// Number of the frame.
    pub frame: usize,
    /// Its regions.
    pub regions: Vec<RegionAudit>,
}

/// Compares a frame with the one before; also returns the result of each pixel. `next` is the frame
/// after it.
pub fn audit_pair(
    [before, after]: [&Capture; 2],
    next: Option<&Capture>,
    frame: usize,
) -> (PairAudit, Raster<MapPixel>) {
    let pair = FramePair::new(before, after);
    let candidates = list_candidates(&pair, next);
    let size = after.color.size();
    let mut map = Raster::filled(size.width, size.height, MapPixel::Excluded);
    let regions = divide(&pair);
    let audits = regions.iter().map(|region| {
        let matches = match_blocks(&pair, &region.blocks);
        draw_region(&pair, region, &matches, &mut map);
        audit_region(&pair, region, &matches, &candidates)
    });
    let regions = audits.collect();
    (PairAudit { frame, regions }, map)
}

fn match_blocks(pair: &FramePair, blocks: &[Block]) -> Vec<Match> {
    let velocity = &pair.after.velocity;
    let reach = (velocity.width / REACH) as i32;
    let reach = reach.clamp(REACHES[0], REACHES[1]);
    let blocks = blocks.par_iter();
    let matches = blocks.map(|block| match_block(pair, block, velocity, reach));
    matches.collect()
}

fn audit_region(
    pair: &FramePair,
    region: &Region,
    matches: &[Match],
    candidates: &[Candidate],
) -> RegionAudit {
    let velocity = &pair.after.velocity;
    let look = |at: &usize| pair.look(*at, pair.place(*at, velocity));
    let seen: Vec<Seen> = region.pixels.iter().map(look).collect();
    let mut evidence = Evidence::of(&region.blocks, matches, &seen);
    evidence.estimate = Estimate::of(pair, &evidence.shifted, velocity);
    let verdict = evidence.judge();
    let speed = |at: &usize| to_vector(velocity.pixels[*at]).length();
    let speed = median(region.pixels.iter().map(speed));
    let is_wrong = matches!(verdict, Verdict::IsOff | Verdict::IsNotTheMotion);
    let find = || {
        if speed <= STILL {
            let zero = SimpleCause::Zero;
            return Some(NamedCause {
                cause: zero,
                looks_like: Vec::new(),
            });
        }
        find_cause(pair, &region.blocks, candidates, evidence.best_offset())
    };
    RegionAudit {
        region: region.name.clone(),
        pixels: region.pixels.len(),
        shares: evidence.shares,
        speed,
        error: evidence.estimate,
        verdict,
        cause: if is_wrong { find() } else { None },
    }
}

/// Draws the result of each block of a region.
fn draw_region(pair: &FramePair, region: &Region, matches: &[Match], map: &mut Raster<MapPixel>) {
    let velocity = &pair.after.velocity;
    for (block, state) in region.blocks.iter().zip(matches) {
        let said = match state {
            Match::Unseen => MapPixel::Excluded,
            Match::Even => MapPixel::Even,
            Match::Unlike => MapPixel::Unlike,
            Match::Shift(shifted) => MapPixel::Shift(shifted.fit.shift.to_array()),
        };
        for at in &block.pixels {
            map.pixels[*at] = match pair.look(*at, pair.place(*at, velocity)) {
                Seen::Same => said,
                Seen::Behind => MapPixel::Behind,
                _ => MapPixel::Excluded,
            };
        }
    }
}
