//! Frames that are rendered again in another form.

use frame::Frame;
use tracer::{PixelGrid, RenderSettings, Scene, TraceError, Watch, trace_frame_part};

use crate::render::velocities::add_further_velocities;
use crate::{Error, Monitor};

/// A scene whose frame is rendered again.
pub(crate) struct Renderer<'a> {
    pub scene: &'a Scene,
    monitor: Monitor,
    /// True if the frame has the velocities that few filters read.
    has_further: bool,
}

impl<'a> Renderer<'a> {
    /// Makes a renderer of frames with all that a frame has.
    pub fn of(frame: &Frame, scene: &'a Scene, monitor: Monitor) -> Self {
        Self {
            scene,
            monitor,
            has_further: frame.velocity_next.is_some() || frame.velocity_z.is_some(),
        }
    }

    /// Renders a frame on a grid of pixels; `what` names it in the progress.
    pub fn frame(
        &self,
        what: &str,
        settings: &RenderSettings,
        grid: &PixelGrid,
    ) -> Result<Frame, Error> {
        let frame = self.watch(what, |watch| {
            trace_frame_part(self.scene, settings, grid, None, watch)
        })?;
        self.complete(frame, settings, grid)
    }

    /// Gives a frame on a grid of pixels the velocities that few filters read, if the frame before it has them.
    pub fn complete(
        &self,
        frame: Frame,
        settings: &RenderSettings,
        grid: &PixelGrid,
    ) -> Result<Frame, Error> {
        match self.has_further {
            true => add_further_velocities(frame, self.scene, settings, grid),
            false => Ok(frame),
        }
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
