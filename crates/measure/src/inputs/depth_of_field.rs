//! The order of depth of field and motion blur.

use std::borrow::Cow;

use frame::Frame;
use scene::Scene;
use tracer::{Defocus, PixelGrid, trace_defocus};

use super::renderer::{Renderer, Renders};
use crate::render::settings::settings_of;
use crate::{Error, Monitor, named};

named! {
    /// Place of depth of field among the passes, in scenes whose camera has a lens.
    pub enum DepthOfField {
        /// Before motion blur: a filter gets colour out of focus, as the lens shows the instant;
        /// velocity and depth are a pinhole's.
        Before = "before",
        /// After motion blur: a filter gets the frame of a pinhole, and its output is defocused as
        /// the lens shows the instant.
        After = "after",
    }
}

impl DepthOfField {
    /// Refuses a form that has no meaning for a scene.
    pub(crate) fn check(self, scene: &Scene) -> Result<(), Error> {
        match (self, scene.camera.lens) {
            (Self::After, None) => Err(Error::Refused(format!(
                "depth_of_field={}: the camera of {} has no lens; give it aperture and focus, or leave out the form or the scene",
                self.name(),
                scene.id
            ))),
            _ => Ok(()),
        }
    }

    /// Returns the frame that a filter gets, and the scene as shown in it.
    pub(crate) fn apply<'s>(
        self,
        frame: Frame,
        scene: &'s Scene,
        renders: &Renders,
        monitor: Monitor,
    ) -> Result<(Frame, Cow<'s, Scene>), Error> {
        match self {
            Self::Before => Ok((frame, Cow::Borrowed(scene))),
            Self::After => {
                let scene = scene.clone().pinhole();
                let settings = settings_of(&frame);
                let grid = PixelGrid::of_picture(settings.width, settings.height);
                let renderer = Renderer::of(&frame, &scene, renders, monitor);
                let frame = renderer.frame("frame of a pinhole", &settings, &grid)?;
                Ok((frame, Cow::Owned(scene)))
            }
        }
    }

    /// Prepares the pass after a filter; none if the filter comes last. [`DepthOfField::check`] has
    /// accepted the scene.
    pub(crate) fn prepare_pass(
        self,
        frame: &Frame,
        scene: &Scene,
        monitor: Monitor,
    ) -> Result<Option<Defocus>, Error> {
        if self == Self::Before {
            return Ok(None);
        }
        let settings = settings_of(frame);
        let renders = Renders::default();
        let pass = Renderer::of(frame, scene, &renders, monitor)
            .watch("depth of field", |watch| {
                trace_defocus(scene, &settings, watch)
            })?;
        Ok(Some(pass))
    }
}
