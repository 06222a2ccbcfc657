//! Rotations as a scene.toml states them, and the turns between them.

use std::fmt;

use glam::{DQuat, DVec3};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::Turn;

/// Largest turn between orientations that give no axis, in degrees. From half a turn on, its
/// direction is ambiguous.
pub(super) const LARGEST_TURN: f64 = 179.9;

/// Distance below which two axes, as unit vectors, are the same except for rounding.
const SAME_AXIS: f64 = 1e-9;

/// Orientation as written: `{ axis, degrees }`, which can state more than one turn, or a quaternion
/// `[x, y, z, w]`.
#[derive(Clone, Copy)]
pub(super) enum Rotation {
    AxisAngle { axis: DVec3, degrees: f64 },
    Quaternion(DQuat),
}

impl Default for Rotation {
    fn default() -> Self {
        Rotation::Quaternion(DQuat::IDENTITY)
    }
}

// Hand-written because serde's untagged enums lose the places of their values, and say only that
// nothing matched.
impl<'de> Deserialize<'de> for Rotation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct AxisAngle {
            axis: [f64; 3],
            degrees: f64,
        }

        struct RotationVisitor;

        impl<'de> Visitor<'de> for RotationVisitor {
            type Value = Rotation;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("{ axis = [x, y, z], degrees = number } or a quaternion [x, y, z, w]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<Rotation, A::Error> {
                let components = <[f64; 4]>::deserialize(SeqAccessDeserializer::new(values))?;
                let length_squared: f64 = components.iter().map(|c| c * c).sum();
                if !length_squared.is_normal() {
                    return Err(A::Error::custom(format!(
                        "rotation is the quaternion {components:?}, which has no length; write [0, 0, 0, 1] for no rotation"
                    )));
                }
                let orientation = DQuat::from_array(components).normalize();
                Ok(Rotation::Quaternion(orientation))
            }

            fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<Rotation, A::Error> {
                let AxisAngle { axis, degrees } =
                    AxisAngle::deserialize(MapAccessDeserializer::new(keys))?;
                let axis = DVec3::from(axis).try_normalize().ok_or_else(|| {
                    A::Error::custom("rotation has the axis [0, 0, 0]; give it a direction")
                })?;
                Ok(Rotation::AxisAngle { axis, degrees })
            }
        }

        deserializer.deserialize_any(RotationVisitor)
    }
}

impl Rotation {
    /// Converts to a quaternion.
    pub(super) fn orientation(self) -> DQuat {
        match self {
            Rotation::AxisAngle { axis, degrees } => {
                DQuat::from_axis_angle(axis, degrees.to_radians())
            }
            Rotation::Quaternion(orientation) => orientation,
        }
    }

    /// Finds the turn to `next`; none if it reaches half a turn and no common axis gives its
    /// direction.
    pub(super) fn turn_to(self, next: Rotation) -> Option<Turn> {
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
