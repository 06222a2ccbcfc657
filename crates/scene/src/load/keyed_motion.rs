//! Motions through keys of a scene.toml.

use std::ops::Range;

use glam::DVec3;
use toml::Spanned;

use super::error::Slip;
use super::rotation::{LARGEST_TURN, Rotation};
use crate::limits::{CLOSEST_KEYS, MAX_KEYS};
use crate::motion::keys::key_times;
use crate::{Interpolation, Key, Motion, Turn};

/// Pose at one key.
pub(super) struct Pose {
    pub(super) time: f64,
    pub(super) translation: DVec3,
    pub(super) rotation: Rotation,
    pub(super) scale: DVec3,
    /// Place in the file.
    pub(super) place: Range<usize>,
}

/// Reads the interpolation between keys; linear by default.
pub(super) fn read_interpolation<K>(
    what: &str,
    interpolation: &Option<Spanned<Interpolation>>,
    keys: &Option<Spanned<Vec<K>>>,
) -> Result<Interpolation, Slip> {
    match interpolation {
        Some(given) if keys.is_none() => {
            let reason =
                format!("{what} has an interpolation but no keys; give it keys, or leave it out");
            Err(Slip::new(given.span(), reason))
        }
        given => Ok(given
            .as_ref()
            .map(|given| *given.get_ref())
            .unwrap_or_default()),
    }
}

/// Builds the motion through poses at rising times.
pub(super) fn build_motion(
    what: &str,
    place: Range<usize>,
    poses: &[Pose],
    interpolation: Interpolation,
) -> Result<Motion, Slip> {
    if !(1..=MAX_KEYS).contains(&poses.len()) {
        let reason = format!("{what} has {} keys; allowed: 1 to {MAX_KEYS}", poses.len());
        return Err(Slip::new(place, reason));
    }
    let mut keys = Vec::new();
    for (index, pose) in poses.iter().enumerate() {
        let turn = match poses.get(index + 1) {
            Some(next) => turn_between(what, pose, next)?,
            None => Turn::NONE,
        };
        keys.push(Key {
            time: pose.time,
            translation: pose.translation,
            orientation: pose.rotation.orientation(),
            scale: pose.scale,
            turn,
        });
    }
    let motion = Motion {
        keys,
        interpolation,
    };
    check_scales(what, poses, &motion)?;
    Ok(motion)
}

/// Refuses times that do not rise, or so close that the speed between them has no meaning. `noun`
/// is a key or a shape.
pub(super) fn check_times(
    what: &str,
    noun: &str,
    [from, to]: [f64; 2],
    place: Range<usize>,
) -> Result<(), Slip> {
    let reason = if to <= from {
        format!("{what} has a {noun} at time {to} after one at {from}; times must rise")
    } else if to - from < CLOSEST_KEYS {
        format!(
            "{what} has {noun}s at times {from:?} and {to:?}; allowed: {CLOSEST_KEYS:e} frames apart or more"
        )
    } else {
        return Ok(());
    };
    Err(Slip::new(place, reason))
}

fn turn_between(what: &str, pose: &Pose, next: &Pose) -> Result<Turn, Slip> {
    let times = [pose.time, next.time];
    check_times(what, "key", times, next.place.clone())?;
    pose.rotation.turn_to(next.rotation).ok_or_else(|| {
        let reason = format!(
            "{what} turns by half a turn or more between two keys, so that its direction is ambiguous; allowed: below \
             {LARGEST_TURN} degrees, or any number of degrees if both keys have {{ axis, degrees }} with the same axis"
        );
        Slip::new(next.place.clone(), reason)
    })
}

/// Refuses scales that pass through 0, from a frame before the instant to a frame after it, and
/// between all keys.
fn check_scales(what: &str, poses: &[Pose], motion: &Motion) -> Result<(), Slip> {
    let earliest = poses[0].time.min(-1.0);
    let latest = poses[poses.len() - 1].time.max(1.0);
    let times = key_times([motion], earliest, latest);
    for span in times.windows(2) {
        let segment = motion.segment(0.5 * (span[0] + span[1]));
        let [start, end] = [span[0], span[1]].map(|time| segment.since(time));
        let inside = (0..3)
            .flat_map(|axis| segment.scale.part(|scale| scale[axis]).turning_points())
            .filter(|since| start < *since && *since < end);
        for since in inside.chain([end, start]) {
            let scale = segment.scale.at(since);
            let (pose, next) = keys_beside(poses, span[1]);
            if (pose.scale * scale).min_element() <= 0.0 {
                let time = span[0] + (since - start);
                let reason = format!(
                    "{what} has scale {:.3} at time {} and would have {scale:.3} at {time}; each factor must keep its \
                     sign, between the keys and beyond them",
                    pose.scale, pose.time
                );
                return Err(Slip::new(next.place.clone(), reason));
            }
        }
    }
    Ok(())
}

/// Keys on either side of a span that ends at `end`; beyond the keys, the nearest two.
fn keys_beside(poses: &[Pose], end: f64) -> (&Pose, &Pose) {
    let last = poses.len() - 1;
    let next = poses
        .partition_point(|pose| pose.time < end)
        .clamp(last.min(1), last);
    (&poses[next.saturating_sub(1)], &poses[next])
}
