//! Defects of a velocity buffer that engines have had.

use frame::{Frame, Vectors, VelocityKind};
use tracer::{PointMotion, Scene, trace_motion};

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
        /// With the jitter of temporal anti-aliasing left in: a quarter of a pixel to the left, a third down.
        Jittered = "jittered",
    }
}

impl VelocityDefect {
    /// Returns a frame's velocity with this defect. [`VelocityDefect::check`] has accepted the frame and the scene.
    pub(crate) fn apply(self, frame: &Frame, scene: Option<&Scene>) -> Result<Vectors, Error> {
        let each = |change: fn([f32; 2]) -> [f32; 2]| Ok(frame.velocity.map(|it| change(*it)));
        if let (Some(motion), Some(scene)) = (self.motion(), scene) {
            return Ok(trace_motion(scene, &settings_of(frame), &motion)?.velocity);
        }
        match self {
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

    /// Returns the motion between points that replaces the frame's own; none if the defect can be made from the frame's.
    fn motion(self) -> Option<PointMotion> {
        match self {
            Self::Lag => Some(PointMotion::FRAME_LATE),
            Self::Stale => Some(PointMotion::PREVIOUS_BUFFER),
            Self::PreviousPixel => Some(PointMotion::PREVIOUS_PIXEL),
            Self::FirstFrame => Some(PointMotion::MATRIX_NEVER_SET),
            Self::NoObject => Some(PointMotion::WITHOUT_OBJECTS),
            Self::NoCamera => Some(PointMotion::WITHOUT_CAMERA),
            _ => None,
        }
    }

    /// Refuses a defect if its motion is unknown: in a capture, or object motion with a buffer of camera motion.
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
        Err(Error::Usage(format!(
            "defect={}: {reason}; allowed there: {}",
            self.name(),
            names.join(", ")
        )))
    }
}
