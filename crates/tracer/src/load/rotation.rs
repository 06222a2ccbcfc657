//! Rotations as a scene.toml states them, and the turns between them.

use glam::{DQuat, DVec3};
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::schema::RotationTable;
use crate::Turn;

/// Largest turn between orientations that give no axis, in degrees. From half a turn on its direction is ambiguous.
pub(super) const LARGEST_TURN: f64 = 179.9;

/// Distance below which two axes, as unit vectors, are the same but for rounding.
const SAME_AXIS: f64 = 1e-9;

/// Orientation as written; an axis and degrees can state more than one turn.
#[derive(Clone, Copy)]
pub(super) enum Rotation {
    AxisAngle { axis: DVec3, degrees: f64 },
    Quaternion(DQuat),
}

impl Rotation {
    pub(super) const NONE: Self = Rotation::Quaternion(DQuat::IDENTITY);

    /// Reads a rotation; refuses one without a direction.
    pub(super) fn read(
        document: &Document,
        table: &Spanned<RotationTable>,
    ) -> Result<Self, SceneError> {
        match *table.get_ref() {
            RotationTable::AxisAngle { axis, degrees } => {
                let axis = DVec3::from(axis).try_normalize().ok_or_else(|| {
                    let reason = "rotation has the axis [0, 0, 0]; give it a direction";
                    document.error(table.span(), reason)
                })?;
                Ok(Rotation::AxisAngle { axis, degrees })
            }
            RotationTable::Quaternion(components) => {
                let length_squared: f64 = components.iter().map(|c| c * c).sum();
                if !length_squared.is_normal() {
                    let reason = format!(
                        "rotation is the quaternion {components:?}, which has no length; \
                         write [0, 0, 0, 1] for no rotation"
                    );
                    return Err(document.error(table.span(), reason));
                }
                Ok(Rotation::Quaternion(
                    DQuat::from_array(components).normalize(),
                ))
            }
        }
    }

    /// Converts to a quaternion.
    pub(super) fn orientation(self) -> DQuat {
        match self {
            Rotation::AxisAngle { axis, degrees } => {
                DQuat::from_axis_angle(axis, degrees.to_radians())
            }
            Rotation::Quaternion(orientation) => orientation,
        }
    }

    /// Finds the turn to `next`; none if it reaches half a turn and no common axis gives its direction.
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
