//! Defects of a velocity buffer, as engines have had them.

use frame::{Frame, Vectors, VelocityKind};
use tracer::{PointMotion, Scene, trace_motion};

use crate::inputs::traced_again::settings_of;
use crate::{Error, named};

/// Jitter of two consecutive frames, as temporal anti-aliasing has it: the second point of the Halton sequence of bases 2 and 3 less
/// the first, in pixels.
const JITTER: [f32; 2] = [-0.25, 1.0 / 3.0];

named! {
    /// A defect of the velocity buffer.
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
    /// Returns the velocity of a frame with this defect. Some defects need the scene: they show motion that the frame does not hold.
    ///
    /// # Errors
    /// The defect needs a scene, and there is none; or its motion cannot be traced.
    pub(crate) fn apply(self, frame: &Frame, scene: Option<&Scene>) -> Result<Vectors, Error> {
        self.check(frame.options.velocity, scene.is_some())?;
        let each = |change: fn([f32; 2]) -> [f32; 2]| Ok(frame.velocity.map(|it| change(*it)));
        match self {
            Self::None => Ok(frame.velocity.clone()),
            Self::Zero => each(|_| [0.0; 2]),
            Self::Double => each(|[x, y]| [2.0 * x, 2.0 * y]),
            Self::Half => each(|[x, y]| [0.5 * x, 0.5 * y]),
            Self::FlipY => each(|[x, y]| [x, -y]),
            Self::Jittered => each(|[x, y]| [x + JITTER[0], y + JITTER[1]]),
            _ => {
                let scene = scene.expect("a scene is there, as was checked");
                trace_defect(frame, scene, &self.motion())
            }
        }
    }

    /// Says which motion of which points the buffer holds.
    fn motion(self) -> PointMotion {
        match self {
            Self::Lag => PointMotion::FRAME_LATE,
            Self::Stale => PointMotion::PREVIOUS_BUFFER,
            Self::PreviousPixel => PointMotion::PREVIOUS_PIXEL,
            Self::FirstFrame => PointMotion::MATRIX_NEVER_SET,
            Self::NoObject => PointMotion::WITHOUT_OBJECTS,
            Self::NoCamera => PointMotion::WITHOUT_CAMERA,
            _ => PointMotion::RIGHT,
        }
    }

    /// Refuses a defect of motion that is not known: that of a capture, or that of objects where only the camera's is taken.
    pub(crate) fn check(self, kind: VelocityKind, has_scene: bool) -> Result<(), Error> {
        if self.motion() == PointMotion::RIGHT {
            return Ok(());
        }
        let known = Self::ALL
            .iter()
            .filter(|defect| defect.motion() == PointMotion::RIGHT);
        let names: Vec<&str> = known.map(|defect| defect.name()).collect();
        let refuse = |reason: &str| {
            Err(Error::Usage(format!(
                "defect={}: {reason}; allowed there: {}",
                self.name(),
                names.join(", ")
            )))
        };
        match (has_scene, kind) {
            (false, _) => {
                refuse("needs the scene's own motion, which an engine's capture does not have")
            }
            (true, VelocityKind::CameraOnly) => refuse(
                "needs the motion of objects, which a velocity of the camera alone does not have",
            ),
            (true, _) => Ok(()),
        }
    }
}

/// Traces the velocity of other points, or of another motion, in the frame's own kind.
fn trace_defect(frame: &Frame, scene: &Scene, motion: &PointMotion) -> Result<Vectors, Error> {
    Ok(trace_motion(scene, &settings_of(frame), motion)?.velocity)
}
