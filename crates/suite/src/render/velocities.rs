//! Velocities that few filters read, added to a frame.

use frame::Frame;
use tracer::{PixelGrid, RenderSettings, Scene, trace_further_velocities};

use crate::Error;

/// Adds the motion to the next frame and the change of depth to a frame of a scene that lacks one of them: two rays per pixel.
/// `settings` and `grid` are those that the frame was rendered with.
pub(crate) fn add_further_velocities(
    frame: Frame,
    scene: &Scene,
    settings: &RenderSettings,
    grid: &PixelGrid,
) -> Result<Frame, Error> {
    if frame.velocity_next.is_some() && frame.velocity_z.is_some() {
        return Ok(frame);
    }
    let (next, z) = trace_further_velocities(scene, settings, grid)?;
    Ok(Frame {
        velocity_next: Some(next),
        velocity_z: Some(z),
        ..frame
    })
}
