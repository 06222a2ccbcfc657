//! What a rasteriser writes of one frame of a sequence.

use frame::{FrameOptions, Truth, VelocityKind};
use metrics::Instant;
use tracer::{PointLayers, PointMotion, RenderSettings, Scene, trace_motion};

use crate::Error;

/// Depth and objects of one frame, with the motion since the frame before, whatever velocity the filter gets.
pub(crate) struct PointsOfFrame {
    points: PointLayers,
}

impl PointsOfFrame {
    /// Samples a scene at one of its frames, for pictures of the settings' size.
    pub fn trace(scene: &Scene, render: &RenderSettings) -> Result<Self, Error> {
        let settings = RenderSettings {
            options: FrameOptions {
                velocity: VelocityKind::PreviousFrame,
                ..FrameOptions::default()
            },
            guard_band: 0,
            ..*render
        };
        Ok(Self {
            points: trace_motion(scene, &settings, &PointMotion::RIGHT)?,
        })
    }

    /// Joins a truth of the frame with its motion.
    pub fn instant(&self, truth: &Truth) -> Instant {
        let points = self.points.clone();
        Instant::new(truth, points.velocity, points.depth, points.object_id)
    }
}
