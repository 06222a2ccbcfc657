//! Velocity that an engine should have output, and its variants under known mistakes.

use frame::{Raster, Size, Vectors, VelocityKind};
use scene::Scene;
use tracer::{PointLayers, PointMotion, RenderSettings, TraceError, trace_motion};

use crate::audit::cause::Cause;
use crate::export::FRAMES_PER_SECOND;

/// Clock rates of engines, in frames per second.
const CLOCK_RATES: [f64; 3] = [60.0, 30.0, 120.0];

/// Layers of the instant with the correct velocity, and velocities caused by known mistakes.
pub struct ExpectedMotion {
    /// Correct: the motion since the previous frame.
    pub right: PointLayers,
    /// Each mistake that shows other motion, with that motion; the simplest first.
    pub mistaken: Vec<(Cause, Vectors)>,
}

impl ExpectedMotion {
    /// Traces all of them, with a dozen rays per pixel.
    pub fn trace(scene: &Scene, size: Size) -> Result<Self, TraceError> {
        let mut since_last = RenderSettings::default().with_size(size);
        since_last.options.velocity = VelocityKind::PreviousFrame;
        let trace = |motion: PointMotion| trace_motion(scene, &since_last, &motion);
        let right = trace(PointMotion::RIGHT)?;
        let mut mistaken = vec![(Cause::Zero, right.velocity.map(|_| [0.0; 2]))];
        let turns = [
            Cause::WrongSign,
            Cause::FlippedY,
            Cause::FlippedX,
            Cause::SwappedAxes,
        ];
        for turn in turns {
            mistaken.push((turn, right.velocity.map(|vector| turn.apply(*vector))));
        }
        let motions = [
            (Cause::ObjectMotionMissing, PointMotion::WITHOUT_OBJECTS),
            (Cause::OwnMotionMissing, PointMotion::WITHOUT_OWN),
            (Cause::DeformationMissing, PointMotion::WITHOUT_SHAPES),
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
        for rate in CLOCK_RATES {
            let motion = PointMotion {
                over: FRAMES_PER_SECOND / rate,
                ..PointMotion::RIGHT
            };
            mistaken.push((Cause::MotionOver(rate), trace(motion)?.velocity));
        }
        mistaken.push((Cause::UpsideDown, upside_down(&right.velocity)));
        let mut instantaneous = since_last;
        instantaneous.options.velocity = VelocityKind::Instantaneous;
        let derivative = trace_motion(scene, &instantaneous, &PointMotion::RIGHT)?;
        mistaken.push((Cause::HalfFrameOff, derivative.velocity));
        Ok(Self { right, mistaken })
    }
}

/// Reverses the order of the rows.
pub(super) fn upside_down<T: Clone>(raster: &Raster<T>) -> Raster<T> {
    let (width, height) = (raster.width, raster.height);
    Raster::from_fn(width, height, |x, y| raster.at(x, height - 1 - y).clone())
}
