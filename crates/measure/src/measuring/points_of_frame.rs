//! Points of one frame of a sequence, as a rasteriser writes them.

use frame::{FrameOptions, Truth, VelocityKind};
use metrics::Instant;
use scene::Scene;
use tracer::{PointLayers, PointMotion, RenderSettings, TraceError, trace_motion};

/// Samples depth and objects of a scene at one of its frames, with the motion since the previous
/// frame, whatever velocity filters get.
pub(crate) fn trace_points(
    scene: &Scene,
    render: &RenderSettings,
) -> Result<PointLayers, TraceError> {
    let settings = RenderSettings {
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            ..FrameOptions::default()
        },
        guard_band: 0,
        ..*render
    };
    trace_motion(scene, &settings, &PointMotion::RIGHT)
}

/// Joins a truth of the frame with its points.
pub(crate) fn make_instant(truth: &Truth, points: PointLayers) -> Instant {
    Instant::new(truth, points.velocity, points.depth, points.object_id)
}
