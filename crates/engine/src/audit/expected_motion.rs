//! Velocity that an engine should have output, and its variants under known mistakes.

use frame::{Raster, Size, Vectors, VelocityKind};
use scene::Scene;
use tracer::{PointLayers, PointMotion, RenderSettings, TraceError, trace_motion};

use crate::audit::cause::Cause;
use crate::audit::structure::WrongDraws;

/// Layers of the instant with the correct velocity, and velocities caused by known mistakes.
pub struct ExpectedMotion<'a> {
    /// Correct: the motion since the previous frame.
    pub right: PointLayers,
    /// Each mistake that shows other motion, with that motion; the simplest first.
    pub mistaken: Vec<(Cause, Vectors)>,
    /// The engine's draw calls, for mistakes of single objects.
    pub draws: WrongDraws<'a>,
}

impl<'a> ExpectedMotion<'a> {
    /// Traces all of them, with a few rays per pixel.
    pub fn trace(scene: &'a Scene, size: Size) -> Result<Self, TraceError> {
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
            let velocity = right.velocity.map(|vector| turn.apply(*vector));
            mistaken.push((turn, velocity));
        }
        let draws = WrongDraws::trace(scene, &right)?;
        mistaken.extend(draws.list_of_all());
        let of_last_points = [
            (Cause::PreviousBuffer, PointMotion::PREVIOUS_BUFFER),
            (Cause::PreviousPixel, PointMotion::PREVIOUS_PIXEL),
        ];
        for (cause, motion) in of_last_points {
            mistaken.push((cause, trace(motion)?.velocity));
        }
        mistaken.push((Cause::UpsideDown, upside_down(&right.velocity)));
        let mut instantaneous = since_last;
        instantaneous.options.velocity = VelocityKind::Instantaneous;
        let derivative = trace_motion(scene, &instantaneous, &PointMotion::RIGHT)?;
        mistaken.push((Cause::HalfFrameOff, derivative.velocity));
        Ok(Self {
            right,
            mistaken,
            draws,
        })
    }
}

/// Reverses the order of the rows.
pub(super) fn upside_down<T: Clone>(raster: &Raster<T>) -> Raster<T> {
    let (width, height) = (raster.width, raster.height);
    Raster::from_fn(width, height, |x, y| raster.at(x, height - 1 - y).clone())
}
