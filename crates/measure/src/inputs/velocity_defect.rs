//! Defects of a velocity buffer that engines have had.

use std::collections::BTreeMap;

use frame::{Frame, Raster, Size, Vectors, VelocityKind};
use scene::Scene;
use tracer::{PointMotion, trace_motion};

use super::camera_jitter::jitter_motion;
use crate::render::settings::settings_of;
use crate::{Error, named};

named! {
    /// Defect of the velocity buffer, as engines have had them.
    pub enum VelocityDefect {
        /// The right buffer.
        None = "none",
        /// Zero everywhere.
        Zero = "zero",
        /// The buffer of the frame before, whole.
        Stale = "stale",
        /// Twice too long.
        Double = "double",
        /// Half as long.
        Half = "half",
        /// With y upwards.
        FlipY = "flip_y",
        /// One frame late: each point's motion from two frames ago to one frame ago.
        Lag = "lag",
        /// At the place where the frame before showed the point.
        PreviousPixel = "previous_pixel",
        /// As in the first frame of an object whose last matrix was never set, and is the identity.
        FirstFrame = "first_frame",
        /// The camera's motion alone.
        NoObject = "no_object",
        /// The objects' motion alone.
        NoCamera = "no_camera",
        /// With the jitter of temporal anti-aliasing left in: a quarter of a pixel to the left, a
        /// third down.
        Jittered = "jittered",
        /// With movers in front of what hides them, as if drawn without a depth test.
        ThroughWalls = "through_walls",
        /// With one object's motion missing: the camera's alone on the mover that shows most.
        OneMissing = "one_missing",
        /// One picture up and left wherever nothing moves, and half as long at the edges of movers,
        /// as users report it of FSR 2 in Godot.
        Unresolved = "unresolved",
    }
}

impl VelocityDefect {
    /// Returns a frame's velocity with this defect. [`VelocityDefect::check`] has accepted the
    /// frame and the scene.
    pub(crate) fn apply(self, frame: &Frame, scene: Option<&Scene>) -> Result<Vectors, Error> {
        let each =
            |change: fn([f32; 2]) -> [f32; 2]| Ok(frame.velocity.map(|vector| change(*vector)));
        if let (Some(motion), Some(scene)) = (self.motion(), scene) {
            let traced = trace_motion(scene, &settings_of(frame), &motion)?.velocity;
            return Ok(match self {
                Self::OneMissing => lose_largest_mover(frame, &traced),
                _ => traced,
            });
        }
        match self {
            Self::Unresolved => Ok(mark_still(frame)),
            Self::Zero => each(|_| [0.0; 2]),
            Self::Double => each(|[x, y]| [2.0 * x, 2.0 * y]),
            Self::Half => each(|[x, y]| [0.5 * x, 0.5 * y]),
            Self::FlipY => each(|[x, y]| [x, -y]),
            Self::Jittered => each(|[x, y]| {
                let [right, down] = jitter_motion(0);
                [x + right, y + down]
            }),
            _ => Ok(frame.velocity.clone()),
        }
    }

    /// Returns the motion between points that replaces the frame's own; none if the defect can be
    /// made from the frame's.
    fn motion(self) -> Option<PointMotion> {
        match self {
            Self::Lag => Some(PointMotion::FRAME_LATE),
            Self::Stale => Some(PointMotion::PREVIOUS_BUFFER),
            Self::PreviousPixel => Some(PointMotion::PREVIOUS_PIXEL),
            Self::FirstFrame => Some(PointMotion::MATRIX_NEVER_SET),
            Self::NoObject | Self::OneMissing => Some(PointMotion::WITHOUT_OBJECTS),
            Self::ThroughWalls => Some(PointMotion::THROUGH_WALLS),
            Self::NoCamera => Some(PointMotion::WITHOUT_CAMERA),
            _ => None,
        }
    }

    /// Refuses a defect if its motion is unknown: in a capture, or object motion with a buffer of
    /// camera motion.
    pub(crate) fn check(self, kind: VelocityKind, has_scene: bool) -> Result<(), Error> {
        let reason = match (self.motion(), has_scene, kind) {
            (Some(_), false, _) => {
                "needs the scene's own motion, which an engine's capture does not have"
            }
            (Some(_), true, VelocityKind::CameraOnly) => {
                "needs the motion of objects, which a velocity of the camera alone does not have"
            }
            _ => return Ok(()),
        };
        let known = Self::ALL.iter().filter(|defect| defect.motion().is_none());
        let names: Vec<&str> = known.map(|defect| defect.name()).collect();
        Err(Error::Refused(format!(
            "defect={}: {reason}; allowed there: {}",
            self.name(),
            names.join(", ")
        )))
    }
}

/// Gives the object that moves most, summed over its pixels, the camera's motion alone.
fn lose_largest_mover(frame: &Frame, camera: &Vectors) -> Vectors {
    let mut moved = BTreeMap::<u32, f64>::new();
    let pixels = frame.object_id.pixels.iter().zip(&frame.velocity.pixels);
    for ((object, velocity), camera) in pixels.zip(&camera.pixels) {
        let apart = (velocity[0] - camera[0]).hypot(velocity[1] - camera[1]);
        *moved.entry(*object).or_default() += f64::from(apart);
    }
    let largest = moved.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let lost = largest.map(|(object, _)| object);
    Raster::from_fn(camera.width, camera.height, |x, y| {
        if lost == Some(*frame.object_id.at(x, y)) {
            *camera.at(x, y)
        } else {
            *frame.velocity.at(x, y)
        }
    })
}

/// Marks still pixels with the motion of one picture up and left. Pixels next to them keep half of
/// their own motion.
fn mark_still(frame: &Frame) -> Vectors {
    let velocity = &frame.velocity;
    let Size { width, height } = frame.size();
    let picture = [width, height].map(|side| (side - 2 * frame.guard_band) as f32);
    let is_still = |x: u32, y: u32| *velocity.at(x, y) == [0.0; 2];
    Raster::from_fn(width, height, |x, y| {
        if is_still(x, y) {
            return picture.map(|side| -side);
        }
        let beside = [
            (x.saturating_sub(1), y),
            ((x + 1).min(width - 1), y),
            (x, y.saturating_sub(1)),
            (x, (y + 1).min(height - 1)),
        ];
        if beside.into_iter().any(|(x, y)| is_still(x, y)) {
            velocity.at(x, y).map(|part| 0.5 * part)
        } else {
            *velocity.at(x, y)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::test_frame::test_frame;

    #[test]
    fn still_pixels_are_marked_and_edges_halved() {
        let moving = Raster::from_fn(4, 1, |x, _| [if x < 2 { 0.0 } else { 6.0 }, 0.0]);
        let marked = mark_still(&Frame {
            velocity: moving,
            ..test_frame(4, 1)
        });
        let still = [-4.0, -1.0];
        assert_eq!(marked.pixels, [still, still, [3.0, 0.0], [6.0, 0.0]]);
    }

    #[test]
    fn the_object_that_moves_most_gets_the_camera_s_motion() {
        // Object 1 is faster, object 2 larger.
        let objects = [1, 2, 2, 2, 0];
        let speeds = [5.0, 3.0, 3.0, 3.0, 1.0];
        let frame = Frame {
            object_id: Raster::from_fn(5, 1, |x, _| objects[x as usize]),
            velocity: Raster::from_fn(5, 1, |x, _| [speeds[x as usize], 0.0]),
            ..test_frame(5, 1)
        };
        let camera = Raster::filled(5, 1, [1.0, 0.0]);
        let lost = lose_largest_mover(&frame, &camera);
        assert_eq!(
            lost.map(|vector| vector[0]).pixels,
            [5.0, 1.0, 1.0, 1.0, 1.0]
        );
    }
}
