//! Rules by which an engine's filter follows the frame rate.

use frame::Frame;
use scene::Scene;

use crate::named;

named! {
    /// Rule by which the filter sets its exposure at another frame rate than that of the scene's
    /// file.
    pub enum ShutterRule {
        /// The exposure of the truth.
        Right = "right",
        /// The share of the frame interval that it has at 60 frames per second.
        InFrames = "in_frames",
        /// The time in seconds that it has at 60 frames per second.
        InTime = "in_time",
        /// That time, and not more than that share.
        InTimeCapped = "in_time_capped",
        /// That share, times 60 and divided by the frame rate.
        ShareFalls = "share_falls",
    }
}

impl ShutterRule {
    /// Returns the frame with the exposure that the filter uses.
    pub(crate) fn apply(self, frame: Frame, scene: &Scene) -> Frame {
        let written = match scene.rate().shutters_per_second {
            // The render settings may have another exposure than the file.
            None => frame.exposure,
            Some(_) => scene.written_exposure,
        };
        let in_time = written * scene.rate().frames_per_written_frame();
        let exposure = match self {
            Self::Right => frame.exposure,
            Self::InFrames => written,
            Self::InTime => in_time,
            Self::InTimeCapped => in_time.min(written),
            Self::ShareFalls => written / scene.rate().frames_per_written_frame(),
        };
        Frame { exposure, ..frame }
    }
}
