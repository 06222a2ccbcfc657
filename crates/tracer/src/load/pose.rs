//! Poses at given times, and the motion through them.

use std::ops::Range;

use glam::{DQuat, DVec3};
use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, list};
use super::schema::{ObjectTable, RotationTable, ScaleTable};
use crate::limits::{CLOSEST_KEYS, MOST_KEYS};
use crate::motion::keys::key_times;
use crate::{Interpolation, Key, Motion, Turn};

/// Two orientations say nothing about the way between them beyond half a turn; this much is kept off it, in degrees.
const LARGEST_TURN: f64 = 179.9;

/// Axes closer than this (as unit vectors) are one axis: rounding in a file, not a choice.
const SAME_AXIS: f64 = 1e-9;

/// The words for the ways between keys.
const INTERPOLATIONS: [(&str, Interpolation); 2] = [
    ("linear", Interpolation::Linear),
    ("cubic", Interpolation::Cubic),
];

/// How an orientation was written; an axis and degrees can say more than one turn.
#[derive(Clone, Copy)]
pub(super) enum Rotation {
    AxisAngle { axis: DVec3, degrees: f64 },
    Quaternion(DQuat),
}

/// A pose that a scene.toml states.
pub(super) struct Pose {
    pub(super) time: f64,
    pub(super) translation: DVec3,
    pub(super) rotation: Rotation,
    pub(super) scale: DVec3,
    /// Where it is written.
    pub(super) place: Range<usize>,
}

impl Rotation {
    pub(super) const NONE: Self = Rotation::Quaternion(DQuat::IDENTITY);

    pub(super) fn read(
        document: &Document,
        table: &Spanned<RotationTable>,
    ) -> Result<Self, SceneError> {
        match *table.get_ref() {
            RotationTable::AxisAngle { axis, degrees } => {
                let axis = DVec3::from(axis).try_normalize().ok_or_else(|| {
                    let reason = "rotation has the axis [0, 0, 0]; a direction is needed";
                    document.error(table.span(), reason)
                })?;
                Ok(Rotation::AxisAngle { axis, degrees })
            }
            RotationTable::Quaternion(components) => {
                let length_squared: f64 = components.iter().map(|c| c * c).sum();
                if !length_squared.is_normal() {
                    let reason = format!(
                        "rotation is the quaternion {components:?}, whose length is not above 0; \
                         no rotation is [0, 0, 0, 1]"
                    );
                    return Err(document.error(table.span(), reason));
                }
                Ok(Rotation::Quaternion(
                    DQuat::from_array(components).normalize(),
                ))
            }
        }
    }

    pub(super) fn orientation(self) -> DQuat {
        match self {
            Rotation::AxisAngle { axis, degrees } => {
                DQuat::from_axis_angle(axis, degrees.to_radians())
            }
            Rotation::Quaternion(orientation) => orientation,
        }
    }

    /// The turn that leads from here to `next`; none when it is not below half a turn and no axis says which way.
    fn turn_to(self, next: Rotation) -> Option<Turn> {
        if let (
            Rotation::AxisAngle { axis, degrees },
            Rotation::AxisAngle {
                axis: next_axis,
                degrees: next_degrees,
            },
        ) = (self, next)
            && axis.distance(next_axis) < SAME_AXIS
        {
            let angle = (next_degrees - degrees).to_radians();
            return Some(Turn { axis, angle });
        }
        let relative = next.orientation() * self.orientation().conjugate();
        let relative = if relative.w < 0.0 {
            -relative
        } else {
            relative
        };
        let sine = relative.xyz().length();
        let angle = 2.0 * sine.atan2(relative.w);
        if angle >= LARGEST_TURN.to_radians() {
            return None;
        }
        Some(match relative.xyz().try_normalize() {
            Some(axis) => Turn { axis, angle },
            None => Turn::NONE,
        })
    }
}

/// The motion of an object, still or through its keys.
pub(super) fn object_motion(
    document: &Document,
    name: &str,
    object: &ObjectTable,
) -> Result<Motion, SceneError> {
    let rotation = |table: &Option<Spanned<RotationTable>>| match table {
        Some(table) => Rotation::read(document, table),
        None => Ok(Rotation::NONE),
    };
    let what = format!("object \"{name}\"");
    let interpolation = interpolation(document, &what, &object.interpolation, &object.keys)?;
    let Some(keys) = &object.keys else {
        return Ok(Motion::still(Key {
            translation: object
                .translation
                .as_ref()
                .map_or(DVec3::ZERO, |translation| {
                    DVec3::from(*translation.get_ref())
                }),
            orientation: rotation(&object.rotation)?.orientation(),
            scale: scale(document, &object.scale)?,
            ..Key::REST
        }));
    };
    let still = object.translation.as_ref().map(Spanned::span);
    let still = still.or(object.rotation.as_ref().map(Spanned::span));
    if let Some(place) = still.or(object.scale.as_ref().map(Spanned::span)) {
        let reason = format!(
            "{what} has both keys and a still pose; write translation, rotation and scale into the keys"
        );
        return Err(document.error(place, reason));
    }
    let mut poses = Vec::new();
    for key in keys.get_ref() {
        poses.push(Pose {
            time: *key.time.get_ref(),
            translation: DVec3::from(key.translation.unwrap_or_default()),
            rotation: rotation(&key.rotation)?,
            scale: scale(document, &key.scale)?,
            place: key.time.span(),
        });
    }
    through(document, &what, keys.span(), &poses, interpolation)
}

/// How the keys are joined; linearly if nothing is said.
pub(super) fn interpolation<K>(
    document: &Document,
    what: &str,
    word: &Option<Spanned<String>>,
    keys: &Option<Spanned<Vec<K>>>,
) -> Result<Interpolation, SceneError> {
    let Some(word) = word else {
        return Ok(Interpolation::default());
    };
    if keys.is_none() {
        let reason = format!(
            "{what} has an interpolation but no keys to go between; give it keys, or leave interpolation out"
        );
        return Err(document.error(word.span(), reason));
    }
    let known = INTERPOLATIONS
        .iter()
        .find(|(name, _)| name == word.get_ref());
    let Some((_, interpolation)) = known else {
        let reason = format!(
            "interpolation of {what} is \"{}\"; allowed: {}",
            word.get_ref(),
            list(INTERPOLATIONS.map(|(name, _)| name))
        );
        return Err(document.error(word.span(), reason));
    };
    Ok(*interpolation)
}

/// The motion through poses at rising times.
pub(super) fn through(
    document: &Document,
    what: &str,
    place: Range<usize>,
    poses: &[Pose],
    interpolation: Interpolation,
) -> Result<Motion, SceneError> {
    if poses.is_empty() {
        let reason = format!("{what} has empty keys; at least one key is needed");
        return Err(document.error(place, reason));
    }
    if poses.len() > MOST_KEYS {
        let reason = format!(
            "{what} has {} keys; allowed: 1 to {MOST_KEYS}; leave out those that lie between others",
            poses.len()
        );
        return Err(document.error(place, reason));
    }
    let mut keys = Vec::new();
    for (index, pose) in poses.iter().enumerate() {
        let turn = match poses.get(index + 1) {
            Some(next) => turn_between(document, what, pose, next)?,
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
    check_scales(document, what, poses, &motion)?;
    Ok(motion)
}

/// Refuses two times so close that the speed between them has no meaning.
pub(super) fn check_gap(
    document: &Document,
    what: &str,
    which: &str,
    [from, to]: [f64; 2],
    place: Range<usize>,
) -> Result<(), SceneError> {
    if to - from >= CLOSEST_KEYS {
        return Ok(());
    }
    let reason = format!(
        "{what} has {which} at times {from:?} and {to:?}; allowed: at least {CLOSEST_KEYS:e} frames from one to the next"
    );
    Err(document.error(place, reason))
}

fn turn_between(
    document: &Document,
    what: &str,
    pose: &Pose,
    next: &Pose,
) -> Result<Turn, SceneError> {
    let place = || next.place.clone();
    if next.time <= pose.time {
        let reason = format!(
            "{what} has a key at time {} after one at {}; times must rise",
            next.time, pose.time
        );
        return Err(document.error(place(), reason));
    }
    check_gap(document, what, "keys", [pose.time, next.time], place())?;
    pose.rotation.turn_to(next.rotation).ok_or_else(|| {
        let reason = format!(
            "{what} turns by half a turn or more between keys, which leaves the way open; allowed: below \
             {LARGEST_TURN} degrees, or give both keys {{ axis, degrees }} with the same axis, which may turn any \
             number of degrees"
        );
        document.error(place(), reason)
    })
}

/// No factor may pass through 0. A motion goes on beyond its keys, and one frame to either side of the instant may be
/// asked for.
fn check_scales(
    document: &Document,
    what: &str,
    poses: &[Pose],
    motion: &Motion,
) -> Result<(), SceneError> {
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
                return Err(document.error(next.place.clone(), reason));
            }
        }
    }
    Ok(())
}

/// The keys between which a stretch ends at `end`; beyond the keys, the nearest two.
fn keys_beside(poses: &[Pose], end: f64) -> (&Pose, &Pose) {
    let last = poses.len() - 1;
    let next = poses
        .partition_point(|pose| pose.time < end)
        .clamp(last.min(1), last);
    (&poses[next.saturating_sub(1)], &poses[next])
}

fn scale(document: &Document, table: &Option<Spanned<ScaleTable>>) -> Result<DVec3, SceneError> {
    let Some(table) = table else {
        return Ok(DVec3::ONE);
    };
    let ScaleTable(factors) = *table.get_ref();
    if factors.contains(&0.0) {
        let reason = format!("scale is {factors:?}; each factor must differ from 0");
        return Err(document.error(table.span(), reason));
    }
    Ok(DVec3::from(factors))
}
