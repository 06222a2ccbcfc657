//! Velocity that an engine should have handed over, and what known mistakes make of it.

use frame::{FrameOptions, Vectors, VelocityKind};
use tracer::{PointLayers, PointMotion, RenderSettings, Scene, TraceError, trace_motion};

use super::cause::Cause;

/// Layers of the instant with the right velocity, and velocities that known mistakes lead to.
pub struct ExpectedMotion {
    /// What is right: the motion since the frame before.
    pub right: PointLayers,
    /// Each mistake that shows other motion, with that motion; the simplest first.
    pub mistaken: Vec<(Cause, Vectors)>,
}

impl ExpectedMotion {
    /// Traces all of them: nine rays per pixel.
    pub fn trace(scene: &Scene, [width, height]: [u32; 2]) -> Result<Self, TraceError> {
        let settings = |velocity| RenderSettings {
            width,
            height,
            options: FrameOptions {
                velocity,
                ..FrameOptions::default()
            },
            ..RenderSettings::default()
        };
        let since_last = settings(VelocityKind::PreviousFrame);
        let trace = |motion: PointMotion| trace_motion(scene, &since_last, &motion);
        let right = trace(PointMotion::RIGHT)?;
        let mut mistaken = vec![
            (Cause::Zero, right.velocity.map(|_| [0.0; 2])),
            (Cause::WrongSign, right.velocity.map(|[x, y]| [-x, -y])),
            (Cause::FlippedY, right.velocity.map(|[x, y]| [*x, -y])),
            (Cause::FlippedX, right.velocity.map(|[x, y]| [-x, *y])),
            (Cause::SwappedAxes, right.velocity.map(|[x, y]| [*y, *x])),
        ];
        let motions = [
            (Cause::ObjectMotionMissing, PointMotion::WITHOUT_OBJECTS),
            (Cause::CameraMotionMissing, PointMotion::WITHOUT_CAMERA),
            (Cause::FrameLate, PointMotion::FRAME_LATE),
            (Cause::PreviousBuffer, PointMotion::PREVIOUS_BUFFER),
            (Cause::PreviousPixel, PointMotion::PREVIOUS_PIXEL),
            (Cause::FrameEarly, PointMotion::FRAME_EARLY),
            (Cause::MatrixNeverSet, PointMotion::MATRIX_NEVER_SET),
        ];
        for (cause, motion) in motions {
            mistaken.push((cause, trace(motion)?.velocity));
        }
        let instantaneous = settings(VelocityKind::Instantaneous);
        let derivative = trace_motion(scene, &instantaneous, &PointMotion::RIGHT)?;
        mistaken.push((Cause::HalfFrameOff, derivative.velocity));
        Ok(Self { right, mistaken })
    }
}
