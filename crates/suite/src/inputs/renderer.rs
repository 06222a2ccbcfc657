//! Frames that are rendered again in another form.

use frame::Frame;
use tracer::{PixelGrid, RenderSettings, Scene, TraceError, Watch, trace_frame_part};

use crate::{Error, Monitor};

/// A scene whose frame is rendered again.
pub(crate) struct Renderer<'a> {
    pub scene: &'a Scene,
    pub monitor: Monitor,
}

impl Renderer<'_> {
    /// Renders a frame on a grid of pixels; `what` names it in the progress.
    pub fn frame(
        &self,
        what: &str,
        settings: &RenderSettings,
        grid: &PixelGrid,
    ) -> Result<Frame, Error> {
        self.watch(what, |watch| {
            trace_frame_part(self.scene, settings, grid, None, watch)
        })
    }

    /// Renders something of the scene, and shows the progress.
    pub fn watch<T>(
        &self,
        what: &str,
        work: impl FnOnce(Watch) -> Result<T, TraceError>,
    ) -> Result<T, Error> {
        let label = format!("{} {what}", self.scene.id);
        Ok(self.monitor.watch(&label, work)?)
    }
}
