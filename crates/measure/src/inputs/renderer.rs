//! Frames that are rendered again in another form.

use std::cell::RefCell;

use frame::{Frame, TracedFrame};
use scene::Scene;
use tracer::{PixelGrid, RenderSettings, TraceError, Watch, trace_frame_part};

use crate::render::velocities::add_further_velocities;
use crate::{Error, Monitor};

/// Frames that one form of a frame has rendered, so that its replicates need not render them again.
#[derive(Default)]
pub(crate) struct Renders {
    /// Each with the hash of its scene and settings, and its grid.
    traced: RefCell<Vec<(String, PixelGrid, TracedFrame)>>,
    /// Replicate whose colour and coverage are taken; none for their mean.
    pub replicate: Option<usize>,
}

/// A scene whose frame is rendered again.
pub(crate) struct Renderer<'a> {
    pub scene: &'a Scene,
    monitor: Monitor,
    renders: &'a Renders,
    /// True if the frame has the velocities that few filters read.
    has_further: bool,
}

impl<'a> Renderer<'a> {
    /// Makes a renderer of frames with all that a frame has.
    pub fn of(frame: &Frame, scene: &'a Scene, renders: &'a Renders, monitor: Monitor) -> Self {
        Self {
            scene,
            monitor,
            renders,
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
        let hash = tracer::frame_hash(self.scene, settings);
        let is_own = |(of, on, _): &&(String, PixelGrid, TracedFrame)| *of == hash && on == grid;
        let mut traced = self.renders.traced.borrow_mut();
        if !traced.iter().any(|render| is_own(&render)) {
            let made = self.watch(what, |watch| {
                trace_frame_part(self.scene, settings, grid, None, watch)
            })?;
            traced.push((hash.clone(), *grid, made));
        }
        let (_, _, render) = (traced.iter().find(is_own)).expect("it was rendered");
        let frame = match self.renders.replicate {
            None => render.frame.clone(),
            Some(index) => render.frame.showing(&render.replicates[index]),
        };
        self.complete(frame, settings, grid)
    }

    /// Gives a frame on a grid of pixels the velocities that few filters read, if the frame before
    /// it has them.
    pub fn complete(
        &self,
        frame: Frame,
        settings: &RenderSettings,
        grid: &PixelGrid,
    ) -> Result<Frame, Error> {
        if self.has_further {
            add_further_velocities(frame, self.scene, settings, grid)
        } else {
            Ok(frame)
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
