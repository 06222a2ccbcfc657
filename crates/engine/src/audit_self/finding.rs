//! Wrong velocity of consecutive frames, in words.

use glam::DVec2;
use serde::Serialize;

use crate::audit_self::estimate::Estimate;
use crate::audit_self::pair_audit::{PairAudit, RegionAudit};
use crate::audit_self::simple_cause::SimpleCause;
use crate::audit_self::verdict::Verdict;

/// Largest difference of equal offsets beyond their intervals, in pixels.
const LEAST_SEPARATION: f64 = 0.05;

/// Something wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SelfFinding {
    /// Region; none if all regions that tell are wrong alike.
    pub region: Option<String>,
    /// Frames in which it is wrong.
    pub frames: Vec<usize>,
    /// The cause, if one explains it.
    pub cause: Option<SimpleCause>,
    /// The finding as a sentence.
    pub text: String,
}

/// A region's wrong frames.
struct Wrong<'a> {
    region: &'a str,
    /// Number of the frame, and the audit of the region in it.
    frames: Vec<(usize, &'a RegionAudit)>,
    /// Number of frames in which the region tells.
    told: usize,
}

/// Lists what is wrong: once for all regions that tell if they are wrong alike, or else once a
/// region.
pub fn list_findings(pairs: &[PairAudit]) -> Vec<SelfFinding> {
    if let Some(finding) = find_jitter(pairs).or_else(|| find_common_cause(pairs)) {
        return vec![finding];
    }
    let wrong = list_wrong(pairs);
    wrong.iter().map(describe).collect()
}

fn is_wrong(region: &RegionAudit) -> bool {
    matches!(region.verdict, Verdict::IsOff | Verdict::IsNotTheMotion)
}

fn tells(region: &RegionAudit) -> bool {
    is_wrong(region) || region.verdict == Verdict::Carries
}

fn list_wrong(pairs: &[PairAudit]) -> Vec<Wrong<'_>> {
    let mut wrong: Vec<Wrong> = Vec::new();
    for pair in pairs {
        for region in pair.regions.iter().filter(|region| tells(region)) {
            let known = wrong.iter().position(|wrong| wrong.region == region.region);
            let at = known.unwrap_or_else(|| {
                wrong.push(Wrong {
                    region: &region.region,
                    frames: Vec::new(),
                    told: 0,
                });
                wrong.len() - 1
            });
            wrong[at].told += 1;
            if is_wrong(region) {
                wrong[at].frames.push((pair.frame, region));
            }
        }
    }
    wrong.retain(|wrong| !wrong.frames.is_empty());
    wrong
}

/// Describes a region's wrong frames by the worst.
fn describe(wrong: &Wrong) -> SelfFinding {
    let error = |region: &RegionAudit| region.error.map_or(0.0, |error| error.size());
    let worst = (wrong.frames.iter())
        .max_by(|(_, one), (_, other)| {
            let is_named = |region: &RegionAudit| region.cause.is_some();
            (is_named(one).cmp(&is_named(other))).then(error(one).total_cmp(&error(other)))
        })
        .expect("a wrong region is wrong in a frame");
    let region = worst.1;
    let cause = region.cause.as_ref();
    let off = || region.error.as_ref().map(describe_error);
    let mut text = format!("velocity of `{}` ", wrong.region);
    text += &match (cause, region.verdict) {
        (Some(cause), _) => {
            let mut words = cause.cause.name().to_owned();
            for other in &cause.looks_like {
                words += &format!(", or {}", other.name());
            }
            words
        }
        (None, Verdict::IsOff) => off().unwrap_or_default(),
        (None, _) => "is not the motion of the picture, in no simple way".to_owned(),
    };
    if wrong.frames.len() < wrong.told {
        let names: Vec<String> = wrong
            .frames
            .iter()
            .map(|(frame, _)| frame.to_string())
            .collect();
        text += &format!(
            ", in {} of {} frames that tell: {}",
            wrong.frames.len(),
            wrong.told,
            names.join(", ")
        );
    }
    SelfFinding {
        region: Some(wrong.region.to_owned()),
        frames: wrong.frames.iter().map(|(frame, _)| *frame).collect(),
        cause: cause.map(|cause| cause.cause),
        text,
    }
}

/// Describes an offset.
fn describe_error(error: &Estimate) -> String {
    let ([x, y], [half_x, half_y]) = (error.bias, error.half_width);
    match error.only_along {
        Some([along_x, along_y]) => format!(
            "is off by {:+.3} +- {:.3} px along ({along_x:+.2}, {along_y:+.2}); nothing is known across",
            x * along_x + y * along_y,
            error.half_width_along
        ),
        None => format!("is off by ({x:+.3}, {y:+.3}) +- ({half_x:.3}, {half_y:.3}) px"),
    }
}

/// Finds one cause of all regions that tell, unless one of them carries and moves.
fn find_common_cause(pairs: &[PairAudit]) -> Option<SelfFinding> {
    let wrong = list_wrong(pairs);
    let cause = wrong.first()?.frames.first()?.1.cause.as_ref()?.cause;
    let is_alike = |region: &RegionAudit| {
        let found = region.cause.as_ref();
        found.is_some_and(|found| found.cause == cause || found.looks_like.contains(&cause))
    };
    let told = pairs.iter().flat_map(|pair| &pair.regions);
    let told: Vec<&RegionAudit> = told.filter(|region| tells(region)).collect();
    // A still region is right with a wrong sign, too.
    let is_right_by_chance = |region: &RegionAudit| !is_wrong(region) && region.speed < 0.1;
    let are_all = wrong.len() > 1
        && (told.iter()).all(|region| is_alike(region) || is_right_by_chance(region));
    are_all.then(|| SelfFinding {
        region: None,
        frames: pairs.iter().map(|pair| pair.frame).collect(),
        cause: Some(cause),
        text: format!("velocity {}, in all regions that tell", cause.name()),
    })
}

/// Finds one offset of all regions of a frame that have an interval: jitter.
fn find_jitter(pairs: &[PairAudit]) -> Option<SelfFinding> {
    let mut frames = Vec::new();
    let mut first = None;
    for pair in pairs {
        let common = pair.regions.iter().filter(|region| is_common(region));
        let errors = common.filter_map(|region| region.error);
        let half = |error: &Estimate| error.half_width_along;
        let Some(offset) = errors.min_by(|one, other| half(one).total_cmp(&half(other))) else {
            continue;
        };
        let known = pair
            .regions
            .iter()
            .filter(|region| tells(region) && region.error.is_some());
        let are_alike = known.clone().all(|region| is_offset(region, &offset));
        // Jitter on a still object is motion of a picture that stands still.
        let is_named = |region: &RegionAudit| {
            let cause = region.cause.as_ref().map(|found| found.cause);
            cause.is_some_and(|cause| cause != SimpleCause::StandsStill)
        };
        if known.count() < 2 || !are_alike || pair.regions.iter().any(is_named) {
            return None;
        }
        frames.push(pair.frame);
        first.get_or_insert(offset);
    }
    let offset = first?;
    let words = describe_error(&offset);
    Some(SelfFinding {
        region: None,
        text: format!(
            "velocity {words} in all regions of frame {}: jitter is left in velocity, or in colour but not in velocity. Upscalers \
             may want the latter; for this audit, draw without jitter",
            frames[0]
        ),
        frames,
        cause: None,
    })
}

fn is_common(region: &RegionAudit) -> bool {
    region.verdict == Verdict::IsOff && region.error.is_some_and(|error| error.only_along.is_none())
}

/// Returns whether a region's error is an offset, within both intervals.
fn is_offset(region: &RegionAudit, offset: &Estimate) -> bool {
    let Some(error) = region.error else {
        return false;
    };
    let difference = DVec2::from(error.bias) - DVec2::from(offset.bias);
    let difference = match error.only_along {
        Some(along) => DVec2::from(along)
            .dot(DVec2::from(offset.bias) - DVec2::from(error.bias))
            .abs(),
        None => difference.length(),
    };
    difference <= LEAST_SEPARATION + 2.0 * (error.half_width_along + offset.half_width_along)
}
