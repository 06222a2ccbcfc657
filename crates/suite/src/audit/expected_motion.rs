//! Velocity that an engine should have handed over, and what known mistakes make of it.

use frame::{FrameOptions, Vectors, VelocityKind};
use tracer::{
    ObjectsBefore, PointLayers, PointMotion, RenderSettings, Scene, TraceError, trace_motion,
};

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
        let own = PointMotion::default();
        let right = trace(own)?;
        let mut mistaken = vec![
            (Cause::Zero, right.velocity.map(|_| [0.0; 2])),
            (Cause::WrongSign, right.velocity.map(|[x, y]| [-x, -y])),
            (Cause::FlippedY, right.velocity.map(|[x, y]| [*x, -y])),
            (Cause::FlippedX, right.velocity.map(|[x, y]| [-x, *y])),
            (Cause::SwappedAxes, right.velocity.map(|[x, y]| [*y, *x])),
        ];
        let motions = [
            (
                Cause::ObjectMotionMissing,
                PointMotion {
                    objects_before: ObjectsBefore::Now,
                    ..own
                },
            ),
            (
                Cause::CameraMotionMissing,
                PointMotion {
                    camera_stands: true,
                    ..own
                },
            ),
            (
                Cause::FrameLate,
                PointMotion {
                    moved_at: -1.0,
                    ..own
                },
            ),
            (
                Cause::PreviousBuffer,
                PointMotion {
                    seen_at: -1.0,
                    moved_at: -1.0,
                    ..own
                },
            ),
            (
                Cause::PreviousPixel,
                PointMotion {
                    seen_at: -1.0,
                    ..own
                },
            ),
            (
                Cause::FrameEarly,
                PointMotion {
                    moved_at: 1.0,
                    ..own
                },
            ),
            (
                Cause::MatrixNeverSet,
                PointMotion {
                    objects_before: ObjectsBefore::Identity,
                    ..own
                },
            ),
        ];
        for (cause, motion) in motions {
            mistaken.push((cause, trace(motion)?.velocity));
        }
        let derivative = trace_motion(scene, &settings(VelocityKind::Instantaneous), &own)?;
        mistaken.push((Cause::HalfFrameOff, derivative.velocity));
        Ok(Self { right, mistaken })
    }
}
