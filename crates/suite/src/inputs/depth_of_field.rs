//! The order of depth of field and motion blur.

use std::borrow::Cow;

use frame::Frame;
use tracer::{Defocus, Scene, trace_defocus, trace_frame};

use crate::inputs::traced_again::settings_of;
use crate::{Error, Monitor, named};

named! {
    /// A place of depth of field among an engine's passes, in scenes whose camera has a lens.
    pub enum DepthOfField {
        /// Before motion blur: a filter gets colour out of focus, as the lens shows the instant; velocity and depth are a pinhole's.
        Before = "before",
        /// After motion blur: a filter gets the frame of a pinhole, and its output is defocused as the lens shows the instant.
        After = "after",
    }
}

impl DepthOfField {
    /// Refuses a form that means nothing for a scene.
    pub(crate) fn check(self, scene: &Scene) -> Result<(), Error> {
        match (self, scene.camera.lens) {
            (Self::After, None) => Err(Error::Usage(format!(
                "depth_of_field={}: the camera of {} has no lens; give it aperture and focus, or leave out the form or the scene",
                self.name(),
                scene.id
            ))),
            _ => Ok(()),
        }
    }

    /// Returns the scene as the filter's frame shows it.
    pub(crate) fn seen_scene(self, scene: &Scene) -> Cow<'_, Scene> {
        match self {
            Self::Before => Cow::Borrowed(scene),
            Self::After => Cow::Owned(scene.clone().pinhole()),
        }
    }

    /// Returns the frame that a filter gets, of the scene of [`DepthOfField::seen_scene`].
    ///
    /// # Errors
    /// The scene cannot be rendered, or the monitor interrupts.
    pub(crate) fn apply(
        self,
        frame: &Frame,
        seen: &Scene,
        monitor: Monitor,
    ) -> Result<Frame, Error> {
        if self == Self::Before {
            return Ok(frame.clone());
        }
        let settings = settings_of(frame);
        let label = format!("{} frame of a pinhole", seen.id);
        Ok(monitor.watch(&label, |watch| trace_frame(seen, &settings, watch))?)
    }

    /// Prepares the pass behind a filter; none where the filter comes last. [`DepthOfField::check`] has passed the scene.
    ///
    /// # Errors
    /// The scene cannot be rendered, or the monitor interrupts.
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
        let label = format!("{} depth of field", scene.id);
        let pass = monitor.watch(&label, |watch| trace_defocus(scene, &settings, watch))?;
        Ok(Some(pass))
    }
}
