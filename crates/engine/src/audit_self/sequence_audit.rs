//! Audit of consecutive frames.

use frame::{Raster, Size};
use measure::Error;
use serde::Serialize;

use crate::audit_self::finding::{SelfFinding, list_findings};
use crate::audit_self::map::MapPixel;
use crate::audit_self::pair_audit::{PairAudit, audit_pair};
use crate::audit_self::sequence::check_same_form;
use crate::audit_self::verdict::Verdict;
use crate::capture::folder::Capture;

/// Limits of an audit without a scene.
const UNKNOWN: [&str; 5] = [
    "motion along an edge, or of a surface without detail",
    "shading that moves without its surface: shadows, reflections",
    "which repetition of a pattern is the right one",
    "what is behind a translucent surface, or moves with it",
    "whether depth and ids are right: they decide what is hidden",
];

/// Audit of the velocity of consecutive frames.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SequenceAudit {
    /// Engine, as named in the first capture.
    pub engine: String,
    /// Size of the pictures.
    pub size: Size,
    /// True if the captures have object ids; otherwise regions are nine parts of the picture.
    pub has_ids: bool,
    /// Number of frames.
    pub frames: usize,
    /// Each frame from the second on.
    pub pairs: Vec<PairAudit>,
    /// True if velocity carries some region, and no other is wrong.
    pub carries: bool,
    /// Findings; empty if nothing is wrong.
    pub findings: Vec<SelfFinding>,
    /// Limits of this audit.
    pub unknown: [&'static str; 5],
}

/// Reads a frame by its number.
pub type ReadFrame<'a> = dyn FnMut(usize) -> Result<Capture, Error> + 'a;
/// Takes the map of a frame, by its number.
pub type TakeMap<'a> = dyn FnMut(usize, &Raster<MapPixel>) -> Result<(), Error> + 'a;

/// Audits some consecutive frames, at least two, three of them in memory.
///
/// # Errors
/// A frame cannot be read or differs in size from the others, or its map cannot be taken.
pub fn audit_frames(
    count: usize,
    read: &mut ReadFrame,
    take_map: &mut TakeMap,
) -> Result<SequenceAudit, Error> {
    assert!(
        count >= 2,
        "velocity leads from one frame to the frame before"
    );
    let mut before = read(0)?;
    let engine = before.description.engine.clone();
    let has_ids = before.object_id.is_some();
    let mut after = read(1)?;
    let mut pairs = Vec::new();
    for frame in 1..count {
        check_same_form(&before, &after)?;
        let next = if frame + 1 < count {
            Some(read(frame + 1)?)
        } else {
            None
        };
        if let Some(next) = &next {
            check_same_form(&after, next)?;
        }
        let (audit, map) = audit_pair([&before, &after], next.as_ref(), frame);
        take_map(frame, &map)?;
        pairs.push(audit);
        before = after;
        match next {
            Some(next) => after = next,
            None => break,
        }
    }
    let findings = list_findings(&pairs);
    let mut regions = pairs.iter().flat_map(|pair| &pair.regions);
    let some_carry = regions.any(|region| region.verdict == Verdict::Carries);
    Ok(SequenceAudit {
        engine,
        size: before.color.size(),
        has_ids,
        frames: count,
        carries: some_carry && findings.is_empty(),
        pairs,
        findings,
        unknown: UNKNOWN,
    })
}
