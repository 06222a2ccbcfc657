//! Motion that turns about a fixed axis, worked out in advance.

use bvh::Ball;
use glam::{DAffine3, DMat3, DVec3};
use scene::{Cubic, Segment};

use crate::motion::pose::Pose;

/// A segment of a motion that turns about one axis and keeps its scale.
///
/// Its matrix is the sum of a constant, a part in proportion to the angle's cosine and one to its
/// sine (Rodrigues' formula). So is the inverse: no matrix has to be inverted.
pub(crate) struct Screw {
    start: f64,
    translation: Cubic<DVec3>,
    /// Greatest factor along any axis.
    scale: f64,
    /// Radians.
    angle: Cubic<f64>,
    to_parent: [DMat3; 3],
    to_object: [DMat3; 3],
}

impl Screw {
    /// The screw of a segment; none if it swings or scales.
    pub fn of(segment: &Segment) -> Option<Self> {
        if segment.swings.is_some() || !segment.scale.is_constant() {
            return None;
        }
        let scale = segment.scale.at(0.0);
        let orientation = DMat3::from_quat(segment.orientation);
        let rest = orientation * DMat3::from_diagonal(scale);
        let back = DMat3::from_diagonal(scale.recip()) * orientation.transpose();
        let DVec3 { x, y, z } = segment.turn.axis;
        let along = DMat3::from_cols(
            x * segment.turn.axis,
            y * segment.turn.axis,
            z * segment.turn.axis,
        );
        let around = DMat3::from_cols(
            DVec3::new(0.0, z, -y),
            DVec3::new(-z, 0.0, x),
            DVec3::new(y, -x, 0.0),
        );
        let parts = [along, DMat3::IDENTITY - along, around];
        Some(Self {
            start: segment.start,
            translation: segment.translation,
            scale: scale.abs().max_element(),
            angle: segment.turn.angle,
            to_parent: parts.map(|part| part * rest),
            to_object: parts.map(|part| back * part.transpose()),
        })
    }

    /// A ball around a mesh of this radius about its origin, in metres, at `time` (frames). It does
    /// not depend on the orientation.
    pub fn ball(&self, radius: f64, time: f64) -> Ball {
        Ball::new(self.translation.at(time - self.start), radius * self.scale)
    }

    /// The pose at `time` (frames) within the segment.
    pub fn at(&self, time: f64) -> Pose {
        let since = time - self.start;
        let (sine, cosine) = self.angle.at(since).sin_cos();
        let sum = |[constant, even, odd]: &[DMat3; 3]| *constant + *even * cosine + *odd * sine;
        let translation = self.translation.at(since);
        let to_object = sum(&self.to_object);
        Pose {
            to_world: DAffine3 {
                matrix3: sum(&self.to_parent),
                translation,
            },
            to_object: DAffine3 {
                matrix3: to_object,
                translation: -(to_object * translation),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;
    use scene::{Interpolation, Key, Motion, Turn};

    use super::*;

    /// A drift of metres and a turn of this many radians about a tilted axis, for a large, flat,
    /// mirrored object.
    fn drifting(angle: f64) -> Motion {
        let axis = DVec3::new(0.36, 0.48, 0.8);
        let start = Key {
            time: -0.5,
            translation: DVec3::new(3.0, -1.0, 2.0),
            orientation: DQuat::from_rotation_x(0.7),
            scale: DVec3::new(20.0, -0.5, 1.0),
            turn: Turn { axis, angle },
        };
        let end = Key {
            time: 0.25,
            translation: DVec3::new(1.0, 4.0, 2.5),
            orientation: DQuat::from_axis_angle(axis, angle) * start.orientation,
            ..start
        };
        Motion {
            keys: vec![start, end],
            interpolation: Interpolation::Linear,
        }
    }

    #[test]
    fn a_screw_goes_where_its_segment_goes_and_back() {
        for angle in [0.0, 0.3, -3.1, 40.0] {
            for (index, segment) in drifting(angle).segments().enumerate() {
                let screw = Screw::of(&segment).expect("it turns about one axis");
                for step in 0..=20 {
                    let time = -1.0 + f64::from(step) / 10.0;
                    let pose = screw.at(time);
                    // Rounding, a few dozen times, of coordinates of up to 20 metres, and of angles
                    // of up to 80 radians.
                    let near = |a: DAffine3, b: DAffine3| a.abs_diff_eq(b, 1e-12);
                    assert!(near(pose.to_world, segment.at(time)), "{index}, {time}");
                    assert!(
                        near(pose.to_object, segment.at(time).inverse()),
                        "{index}, {time}"
                    );
                    assert!(near(pose.to_object * pose.to_world, DAffine3::IDENTITY));
                }
            }
        }
    }

    #[test]
    fn what_grows_or_swings_is_no_screw() {
        let mut growing = drifting(0.5);
        growing.keys[1].scale.x = 21.0;
        let mut swinging = drifting(0.5);
        swinging.interpolation = Interpolation::Cubic;
        for motion in [growing, swinging] {
            let between = motion.segment(0.0);
            assert!(Screw::of(&between).is_none());
        }
    }
}
