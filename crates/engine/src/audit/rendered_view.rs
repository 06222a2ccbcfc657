//! Frames of the scene that a capture is compared with.

use std::ops::ControlFlow;

use frame::{ColorSampling, Frame, FrameOptions};
use tracer::{RenderSettings, Scene, TraceError, trace_frame};

/// Renders the frame of a scene's instant.
pub fn render_view(
    scene: &Scene,
    [width, height]: [u32; 2],
    samples_per_pixel: u32,
    color: ColorSampling,
) -> Result<Frame, TraceError> {
    let settings = RenderSettings {
        width,
        height,
        samples_per_pixel,
        replicates: 1,
        options: FrameOptions {
            color,
            ..FrameOptions::default()
        },
        ..RenderSettings::default()
    };
    trace_frame(scene, &settings, &|_| ControlFlow::Continue(()))
}
